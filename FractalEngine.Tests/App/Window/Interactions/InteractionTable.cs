using static FractalEngine.Tests.App.Window.Interactions.Scenario;

namespace FractalEngine.Tests.App.Window.Interactions;

/// <summary>Interactions with each kind of control, by panel.</summary>
internal static partial class InteractionTable
{
    // Middles of the two cubes of the scene, and a pixel beside them.
    private const int LeftX = 450;
    private const int RightX = 677;
    private const int MiddleY = 350;

    // A pixel of the background.
    private const int SkyX = 800;
    private const int SkyY = 200;

    // The same while a panel is open at the right edge, which the view makes room for.
    private const int LeftAside = LeftX - 149;
    private const int RightAside = RightX - 149;

    private static readonly string SceneText = InteractionFiles.Scene;

    /// <summary>The rows whose tests run by default; the others run in the soak.</summary>
    public static readonly string[] Default =
    [
        "rename an object", "save a number and the view together",
    ];

    /// <summary>The interactions of all panels and of the window, in this order.</summary>
    public static IEnumerable<Interaction> All =>
        [.. OfScene, .. OfRefusedEdits, .. OfRaces, .. OfLights, .. OfFractal, .. OfView, .. OfSelection, .. OfPhysics, .. OfWindow];

    private static IEnumerable<Interaction> OfScene =>
    [
        new("rename an object", "scene.sdo",
            [Keys("F2"), Click("left"), Type("red cube", "name", 1, 2), Save()],
            [Shows("red cube"), FileHas("60\no \"cube.obj\" # name \"red cube\" colour (0.8, 0.3, 0.2)\n# between\n")]),
        new("hide an object", "scene.sdo",
            [Keys("F2"), Click("right"), Click("Hide"), Shows("Objects (1)"), Save()],
            [FrameDiffers(0.002), Shows("Hidden: a click"), FileHas("\n#hidden o \"cube.obj\" ((3, 0, 0), #, #) name \"right\"\n")]),
        new("show a hidden object again", "scene.sdo",
            [Keys("F2"), Click("right"), Click("Hide"), Shows("Objects (1)"), Click("o \"cube.obj\" ((3"), Shows("Objects (2)")],
            [FrameIsAsBefore, Title("scene.sdo -")]),
        new("add an object by Enter", "scene.sdo",
            [Keys("F2"), Click("file (.obj, .fdo"), Text("row.fdo"), Keys("Return"), Shows("Objects (3)"), Save()],
            [FrameDiffers(0.002), FileHas("name \"right\"\no \"row.fdo\" ")]),
        new("add an object by the button", "scene.sdo",
            [Keys("F2"), Click("file (.obj, .fdo"), Text("row.fdo"), Click("Add", right: 0), Shows("Objects (3)")],
            [FrameDiffers(0.002), Title("scene.sdo*")]),
        new("type a position", "scene.sdo",
            [Keys("F2"), Click("left"), Type("1.25", "position", 1, 3, 1), Shows("1.25"), Save()],
            [FrameDiffers(0.002), FileHas("((0, 1.25, 0), #, #) name \"left\" colour (0.8, 0.3, 0.2)")]),
        new("drag a rotation", "scene.sdo",
            [Keys("F2"), Click("left"), Slide(25, "rotation in degrees", 2, 3, 1)],
            [FrameDiffers(0.0005), Title("scene.sdo*"), Keys("ctrl+z"), Title("scene.sdo -"), ClickAt(SkyX, SkyY), FrameIsAsBefore]),
        new("type a scale", "scene.sdo",
            [Keys("F2"), Click("left"), Type("2", "scale", 1, 3, 1), Save()],
            [FrameDiffers(0.002), FileHas("#, (1, 2, 1)) name \"left\"")]),
        new("type a colour", "scene.sdo",
            [Keys("F2"), Click("left"), Type("0.1", "colour", 0, 3, 1), Save()],
            [FrameDiffers(0.005), FileHas("name \"left\" colour (0.1, 0.3, 0.2)")]),
        new("type a background", "scene.sdo",
            [Keys("F2"), Type("0.9", "Background", 0, 3, 1), Save()],
            [FrameDiffers(0.5), FileHas("\nbackground (0.9, ")]),
        new("fold and open the tree", "scene.sdo",
            [Keys("F2"), Shows("right"), Click("Objects (2)"), Hides("right"), Click("Objects (2)")],
            [Shows("right"), Title("scene.sdo -")]),
        new("fold a panel by its title", "scene.sdo",
            [Keys("F2"), Shows("Objects"), Click("Scene")],
            [Hides("Objects"), SettingsHave("panel scene open folded")]),
        new("close a panel", "scene.sdo",
            [Keys("F2"), Shows("Objects"), ClickAt(287, 31)],
            [Hides("Objects"), SettingsHave("panel scene closed")]),
        new("move a panel by its title", "scene.sdo",
            [Keys("F2"), DragText("Scene", 260, 150)],
            [Shows("Objects"), SettingsHave("panel scene open unfolded floating"), FrameIsAsBefore]),
        new("dock a panel at the other edge", "scene.sdo",
            [Keys("F2"), DragText("Scene", 852, 40)],
            [Shows("Objects"), SettingsHave("panel scene open unfolded right")]),
        new("scroll a long list", "many.sdo",
            [Keys("F2"), Shows("cube 3"), Hides("cube 57"), Wheel(100, 200, -60)],
            [Shows("cube 57"), FrameIsAsBefore, Wheel(100, 200, 60), Shows("cube 3")]),
        new("duplicate, then undo and redo", "scene.sdo",
            [Keys("F2"), Click("left"), Click("Duplicate"), Shows("Objects (3)"), Keys("ctrl+z"), Shows("Objects (2)")],
            [FrameIsAsBefore, Keys("ctrl+shift+z"), Shows("Objects (3)"), FrameDiffers(0.001)]),
        new("type the camera", "scene.sdo",
            [Keys("F2"), Click("Camera"), Type("-10", "position", 2, 3, 1), FrameDiffers(0.002), Keys("ctrl+s"),
                Reports("saved scene.sdo")],
            [FrameDiffers(0.002), FileHas("\nc (0, 0, -10) (0, 0, 0) 60\n")]),
        new("a faulty number stays as it was", "scene.sdo",
            [Keys("F2"), Click("left"), Type("1.2.3", "position", 0, 3, 1)],
            [ClickAt(SkyX, SkyY), FrameIsAsBefore, Title("scene.sdo -")]),
        new("copy, cut and paste in a field", "scene.sdo",
            [Keys("F2"), Click("file (.obj, .fdo"), Text("abcdef"), Keys("ctrl+a ctrl+x"), Hides("abcdef"), Keys("ctrl+v ctrl+v")],
            [Shows("abcdefabcdef"), Keys("Home Delete End BackSpace"), Shows("bcdefabcde"), Hides("abcdefabcdef")]),
    ];

    private static IEnumerable<Interaction> OfLights =>
    [
        new("add a sun", "scene.sdo",
            [Keys("F2"), Click("Lights (0)"), Click("Add a sun"), Shows("Lights (1)"), Save()],
            [FrameDiffers(0.002), FileHas("\nlight directional ")]),
        new("add a lamp", "scene.sdo",
            [Keys("F2"), Click("Lights (0)"), Click("Add a lamp"), Shows("Lights (1)"), Save()],
            [FileHas("\nlight point (0, 0, -8) ")]),
        new("add a ball of light", "scene.sdo",
            [Keys("F2"), Click("Lights (0)"), Click("Add a ball"), Shows("Lights (1)"), Click("Ball"),
                Type("0.25", "radius", rows: 0), Save()],
            [FrameDiffers(0.002), FileHas("\nlight ball ("), FileHas(" 0.25 (1, 1, 1) 0.7 ")]),
        new("add a quad of light", "scene.sdo",
            [Keys("F2"), Click("Lights (0)"), Click("Add a quad"), Click("Quad"), Type("0.5", "width", rows: 0), Save()],
            [FrameDiffers(0.002), FileHas("\nlight quad ("), FileHas(" (0, -1, 0) 0.5 ")]),
        new("type an intensity", "lit.sdo",
            [Keys("F2"), Click("Lights (2)"), Click("Directional"), Type("0.1", "intensity", rows: 0), Save("lit.sdo")],
            [FrameDiffers(0.002), FileHas("light directional (1, -2, 1) (1, 1, 1) 0.1", "lit.sdo")]),
        new("type a light's colour", "lit.sdo",
            [Keys("F2"), Click("Lights (2)"), Click("Directional"), Type("0", "intensity", 0, 3, 1), Save("lit.sdo")],
            [FrameDiffers(0.002), FileHas("light directional (1, -2, 1) (0, 1, 1) 0.7", "lit.sdo")]),
        new("remove a light", "lit.sdo",
            [Keys("F2"), Click("Lights (2)"), Click("Directional"), Click("Remove the light"), Shows("Lights (1)"), Save("lit.sdo")],
            [FileIs(SceneText + "light ambient (1, 1, 1) 0.2\n", "lit.sdo")]),
        new("type a zenith", "scene.sdo",
            [Keys("F2"), Click("Sky and haze"), Click("sky", right: -10), Type("0.9", "zenith", 0, 3, 1), Save()],
            [FrameDiffers(0.3), FileHas("\nsky (0.9, 0.45, 0.75) ")]),
        new("type the turn of a sky's image", "field.sdo",
            [Keys("F2"), Click("Sky and haze"), Shows("field.hdr"), Type("90", "turn", rows: 0), Save("field.sdo")],
            [FrameDiffers(0.1), FileHas("\nsky \"field.hdr\" turn 90 scale 2\n", "field.sdo")]),
    ];

    private static IEnumerable<Interaction> OfFractal =>
    [
        new("depth by the arrow keys", "row.fdo",
            [Keys("F4"), Shows("depth of z"), Keys("Tab Tab Right Right"), Title("row.fdo*"), Save("row.fdo")],
            [FrameDiffers(0.001), FileHas("<$>. z   5\n# kept too\n", "row.fdo")]),
        new("a number is explained by the file's comment", "row.fdo", [Keys("F4"), PointAt("0.5")], [Shows("kept: three cubes")]),
        new("drag of a number is one step", "row.fdo",
            [Keys("F4"), Slide(40, "position", 0, 3, 1), Title("row.fdo*"), FrameDiffers(0.001), Keys("ctrl+z")],
            [FrameIsAsBefore, Title("row.fdo -"), Keys("ctrl+z"), FrameIsAsBefore]),
        new("type a scale of a fractal", "row.fdo",
            [Keys("F4"), Type("0.25", "scale", 1, 3, 1), Shows("0.25"), Save("row.fdo")],
            [FrameDiffers(0.001),
                FileIs(InteractionFiles.Row.Replace("0.5 0.5 0.5", "0.5 0.25 0.5", StringComparison.Ordinal), "row.fdo")]),
        new("undo and redo of two numbers", "row.fdo",
            [Keys("F4"), Type("2", "position", 0, 3, 1), Shows("depth"), Type("1", "position", 1, 3, 1), Title("row.fdo*"),
                FrameDiffers(0.002), Keys("ctrl+z ctrl+z"), FrameIsAsBefore, Title("row.fdo -"), Keys("ctrl+shift+z ctrl+shift+z"),
                Title("row.fdo*"), Save("row.fdo")],
            [FileIs(InteractionFiles.Row.Replace("1.5   0 0", "2   1 0", StringComparison.Ordinal), "row.fdo")]),
        new("a number out of its range becomes the nearest within", "row.fdo",
            [Keys("F4"), Shows("8"), Type("-3", "depth of z")],
            [Shows("12"), FrameDiffers(0.001)]),
        new("choose one of two fractals", "two.sdo",
            [Keys("F4"), Click("other.fdo"), Shows("16"), Type("5", "depth of z")],
            [Shows("32"), Title("two.sdo*"), Save("other.fdo"), FileHas("<$>. z 5\n", "other.fdo"),
                FileIs(InteractionFiles.Row, "row.fdo")]),
        new("a click on an instance leads to its numbers", "row.fdo",
            [OpenSelection, ClickAt(411, 375), Shows("level 3"), Click("Its numbers"), Shows("depth of z")],
            [Shows("▶ position 1"), Shows("▶ scale 2"), Keys("Escape Escape"), Hides("▶ position 1")]),
        new("a fractal that outgrows the frame is followed", "row.fdo",
            [Keys("F4"), Type("30", "position", 0, 3, 1), Title("row.fdo*"), FrameDiffers(0.01)],
            [PixelIsBackground(899, 350, isBackground: true), PixelIsBackground(0, 350, isBackground: true), Keys("ctrl+z"),
                FrameIsAsBefore]),
        new("facts follow a number", "row.fdo",
            [Keys("F4"), Shows("8"), Type("0", "depth of z")],
            [Shows("12"), FrameDiffers(0.001)]),
        new("the dimension follows a number", "two.sdo",
            [Keys("F4"), Click("other.fdo"), Shows("dimension"), PointAt("dimension")], [Shows("similarity dimension s")]),
    ];

    private static IEnumerable<Interaction> OfView =>
    [
        new("type a field of view", "scene.sdo",
            [Keys("F3"), Type("90", "field of view", isRight: true)],
            [FrameDiffers(0.005), Keys("ctrl+z"), FrameIsAsBefore]),
        new("Ctrl+click focuses the lens, selects nothing, and leaves the focus where nothing is", "scene.sdo",
            [ControlClickAt(LeftX, MiddleY), FrameIsAsBefore, ControlClickAt(SkyX, SkyY), Keys("ctrl+s"), Reports("saved scene.sdo")],
            [FileHas("c (0, 0, -8) (0, 0, 0) 60 focus 7.5\n"), Keys("F3"), Shows("7.5")]),
        new("view from the top", "scene.sdo", [Keys("F3"), Click("Top")], [FrameDiffers(0.005), Title("scene.sdo")]),
        new("view from the right", "scene.sdo", [Keys("F3"), Click("Right")], [FrameDiffers(0.005)]),
        new("frame the scene", "scene.sdo",
            [Keys("F3"), Click("Frame the scene"), FrameDiffers(0.01), Click("File's camera")], [FrameIsAsBefore]),
        new("orthographic by its box", "scene.sdo",
            [Keys("F3"), Click("Orthographic"), FrameDiffers(0.001), Click("Orthographic")], [FrameIsAsBefore]),
        new("wireframe by its box", "scene.sdo",
            [Keys("F3"), Click("Wireframe"), FrameDiffers(0.005), Click("Wireframe")], [FrameIsAsBefore]),
        new("grid by its box", "scene.sdo",
            [Keys("F3"), Click("Grid and axes"), FrameDiffers(0.002), Click("Grid and axes")], [FrameIsAsBefore]),
        new("light at the vertices", "lit.sdo",
            [Keys("F3"), Click("Pixel light")], [Shows("lighting: per vertex"), Click("Pixel light"), FrameIsAsBefore]),
        new("type a detail", "row.fdo",
            [Keys("F3"), Type("20", "detail", isRight: true)], [Shows("20"), Type("0.5", "detail", isRight: true), FrameIsAsBefore]),
        new("occlusion culling changes no pixel", "row.fdo", [Keys("F3"), Click("Occlusion culling")],
            [FrameIsAsBefore, Title("row.fdo -")]),
        new("shadows by their box", "lit.sdo", [Keys("F3"), Click("Shadows"), Click("Shadows")], [FrameIsAsBefore]),
        new("ambient occlusion by its box", "row.fdo",
            [Keys("F3"), Click("Ambient occlusion"), Click("Ambient occlusion")], [FrameIsAsBefore]),
        new("boxes of a level", "row.fdo",
            [Keys("F3"), Type("1", "level boxes", isRight: true), FrameDiffers(0.001), Type("-1", "level boxes", isRight: true)],
            [FrameIsAsBefore]),
        new("bookmark", "scene.sdo",
            [Keys("F3"), Click("Remember this view"), Shows("view 1"), Keys("1 7"), FrameDiffers(0.005), Click("view 1")],
            [FrameIsAsBefore]),
        new("remove a bookmark", "scene.sdo",
            [Keys("F3"), Click("Remember this view"), Click("view 1", right: 250)], [Hides("view 1")]),
        new("section across an axis by its box and button", "scene.sdo",
            [Keys("F3"), Click("Section", right: -20), FrameDiffers(0.001), Remember, Click("Flip", right: -210), FrameDiffers(0.001),
                Keys("Escape k")],
            [Hides("distance")]),
        new("type a section's normal", "scene.sdo",
            [Keys("F3 k"), Remember, Type("0.5", "normal", 0, 3, 1, isRight: true)], [FrameDiffers(0.001), Title("scene.sdo -")]),
        new("flip and cap of a section by keys", "scene.sdo",
            [Keys("k"), Remember, Keys("ctrl+shift+k"), FrameDiffers(0.001), Keys("ctrl+shift+k"), FrameIsAsBefore, Keys("ctrl+k")],
            [FrameDiffers(0.001), Keys("ctrl+k"), FrameIsAsBefore]),
        new("a section can't be clicked away", "scene.sdo",
            // Cut at the middle towards the eye: the near half is gone, so the click meets the section behind it.
            [OpenSelection, Keys("k"), ClickAt(LeftAside, MiddleY)], [Shows("left (0)"), Shows("distance")]),
    ];

    private static IEnumerable<Interaction> OfSelection =>
    [
        new("double click orbits around the point", "scene.sdo",
            [PixelNote, ClickAt(RightX, MiddleY, 2)], [FrameDiffers(0.01), PixelIsBackground(450, 350, isBackground: false)]),
        new("copy a selection", "scene.sdo",
            [OpenSelection, ClickAt(LeftAside, MiddleY), Shows("left (0)"), Keys("ctrl+c")], [ClipboardHas("object: left (0)")]),
        new("a click beside all selects nothing", "scene.sdo",
            [OpenSelection, ClickAt(LeftAside, MiddleY), Shows("left (0)"), ClickAt(411, 600)],
            [Shows("Click a surface"), FrameIsAsBefore]),
        new("measure two points", "scene.sdo",
            [OpenSelection, Keys("m"), ClickAt(LeftAside, MiddleY), Shows("click the second point"), ClickAt(RightAside, MiddleY)],
            [Shows("two points: 2.8"), FrameDiffers(0.0005)]),
        new("double click while measuring", "scene.sdo",
            [OpenSelection, Keys("m"), ClickAt(LeftAside, MiddleY, count: 2), ClickAt(RightAside, MiddleY)],
            [Shows("two points: 2.8")]),
        new("measure two objects", "scene.sdo",
            [OpenSelection, Click("two objects"), Keys("Escape m"), ClickAt(LeftAside, MiddleY), ClickAt(RightAside, MiddleY)],
            [Shows("left to right: 2")]),
        new("measure a point to an object", "scene.sdo",
            [OpenSelection, Click("point to object"), Keys("Escape m"), ClickAt(LeftAside, MiddleY), ClickAt(RightAside, MiddleY)],
            [Shows("point to right: 2.5")]),
        new("the first of two points is marked", "scene.sdo",
            [OpenSelection, Keys("m"), ClickAt(LeftAside, MiddleY), Shows("click the second point")],
            [FrameDiffers(0.00005), Keys("Escape"), Shows("Measure"), FrameIsAsBefore]),
        new("a measured distance follows its objects", "scene.sdo",
            [OpenSelection, Click("two objects"), Keys("Escape m"), ClickAt(LeftAside, MiddleY), ClickAt(RightAside, MiddleY),
                Shows("left to right: 2"), Keys("m"), ClickAt(LeftAside, MiddleY), Shows("left (0)"), Keys("2"),
                Type("-1", "position", 0, 3, 1, isRight: true), Title("scene.sdo*")],
            [Shows("left to right"), Shows(" 3"), Keys("ctrl+z"), Title("scene.sdo -")]),
        new("remove a distance", "scene.sdo",
            [OpenSelection, Keys("m"), ClickAt(LeftAside, MiddleY), ClickAt(RightAside, MiddleY), FrameDiffers(0.0005), Keys("m"),
                ClickAt(880, 198)],
            [FrameIsAsBefore]),
        new("Esc ends measuring, then selects nothing", "scene.sdo",
            [OpenSelection, ClickAt(LeftAside, MiddleY), Shows("left (0)"), Keys("m Escape"), Shows("left (0)"), Keys("Escape")],
            [Shows("Click a surface"), FrameIsAsBefore]),
        new("Backspace selects the object", "row.fdo",
            [OpenSelection, ClickAt(411, 375), Shows("level 3"), Keys("BackSpace BackSpace BackSpace")], [Shows("the whole object")]),
        new("scale by a handle", "scene.sdo",
            [ClickAt(LeftX, MiddleY), Keys("6"), Drag(LeftX, MiddleY, LeftX + 40, MiddleY, key: "ctrl"), Save()],
            [FileHas("#, (1.5, 1.5, 1.5)) name \"left\"")]),
        new("turn by a handle, with a typed number after", "scene.sdo",
            [OpenSelection, ClickAt(LeftAside, MiddleY), Keys("4"),
                Drag(LeftAside + 80, MiddleY, LeftAside + 60, MiddleY - 60, key: "ctrl"),
                Title("scene.sdo*"),
                Type("30", "rotation in degrees", 0, 3, 1, isRight: true), Shows("30"), Save()],
            [FileHas("(30, 0, -45), #) name \"left\"")]),
        new("select at a magnification beyond world space", "endless.fdo",
            [OpenSelection, Wheel(LeftAside, MiddleY, 120), ClickAt(LeftAside, MiddleY, 2), Wheel(LeftAside, MiddleY, 120), Remember,
                ClickAt(LeftAside, MiddleY), Shows("instance at level")],
            [FrameDiffers(0.0001), Shows("E-"), Keys("BackSpace BackSpace"), Shows("sub-fractal at level")])
        {
            Options = ["--detail", "60"],
        },
    ];

    private static IEnumerable<Interaction> OfPhysics =>
    [
        new("drop a ball", "scene.sdo", [Keys("F5"), Shows("0 bodies"), Click("Drop a ball")], [Shows("1 body")]),
        new("drop a ball at speed zero", "scene.sdo",
            [Keys("F5"), Shows("0 bodies"), Type("0", "speed", isRight: true), Remember, Click("Drop a ball"), Shows("1 body")],
            [FrameDiffers(0.0001), Remember, FrameIsAsBefore, Keys("r"), Shows("0 bodies")]),
        new("drop a ball while paused", "scene.sdo",
            [Keys("F5"), Shows("0 bodies"), Keys("space"), Shows("paused"), Keys("b"), Shows("1 body")],
            [FrameDiffers(0.0001), Keys("r"), Shows("0 bodies"), FrameIsAsBefore]),
        new("drop what is selected", "scene.sdo",
            [OpenSelection, ClickAt(LeftAside, MiddleY), Shows("left (0)"), Remember, Keys("b")],
            [FrameDiffers(0.001), Title("scene.sdo*"), Save(), FileHas("shape mesh"), FileHas("name \"left\""),
                FileHas("\np \"cube.obj\"")]),
        new("throw a ball by its key", "scene.sdo", [Keys("F5"), Shows("0 bodies"), Keys("ctrl+b")], [Shows("1 body")]),
        new("pause and step", "scene.sdo",
            [Keys("F5"), Click("Pause"), Shows("paused"), Click("Drop a ball"), Shows("1 body"), Click("One step"), Shows("step 1,"),
                Click("One step")],
            [Shows("step 2,"), Shows("paused")]),
        new("reset bodies", "scene.sdo", [Keys("F5"), Click("Drop a ball"), Shows("1 body"), Click("Reset bodies")],
            [Shows("0 bodies"), FrameIsAsBefore]),
        new("next collider", "scene.sdo", [Keys("F5"), Click("Next collider")], [Shows("collider")]),
        new("closest points", "scene.sdo", [Keys("F5"), Click("Closest points")],
            [Title("scene.sdo"), Click("Closest points"), FrameIsAsBefore]),
        new("walk and fly again", "scene.sdo", [Keys("F5"), Click("Walk"), Keys("Escape p")], [Title("scene.sdo")]),
    ];

    /// <summary>Opens the panel of the selection, beside which the view stands from then on.</summary>
    private static Action<Scenario> OpenSelection => static s =>
    {
        Keys("F6")(s);
        Shows("Distances")(s);
    };

    private static Action<Scenario> PixelNote => PixelIsBackground(560, 600, isBackground: true);
}
