using static FractalEngine.Tests.App.Window.Interactions.Scenario;

namespace FractalEngine.Tests.App.Window.Interactions;

/// <content>Interactions with the window itself: menus, the list of keys, questions and the camera.</content>
internal static partial class InteractionTable
{
    private static IEnumerable<Interaction> OfWindow =>
    [
        new("new fractal", "scene.sdo",
            [Click("File"), Click("New fractal"), Shows("a trunk with branches"), Keys("s"), Shows("triangle.fdo"), Keys("Return"),
                Title("triangle.fdo -"), Type("4", "depth of z"), Title("triangle.fdo*"), Save("triangle.fdo")],
            [FrameDiffers(0.01), FileHas("<$>. z 4\n", "triangle.fdo"), FileHas("\nf ", "triangle-base.obj"),
                Keys("ctrl+o ctrl+u"), Text("scene.sdo"), Keys("Return"), Title("scene.sdo -"),
                Keys("ctrl+o ctrl+u"), Text("triangle.fdo"), Keys("Return"), Title("triangle.fdo -"), Shows("81")]),
        new("new fractal under a name that is taken", "scene.sdo",
            [Keys("ctrl+n"), Shows("a trunk with branches"), Keys("c"), Shows("cubes.fdo"), Keys("ctrl+u"), Text("row"), Keys("Return")],
            [Shows("row.fdo exists already"), Keys("Escape"), FileIs(InteractionFiles.Row, "row.fdo"), Title("scene.sdo -"),
                FrameIsAsBefore]),
        new("shadows, searched in the keys", "scene.sdo",
            [Keys("h"), Text("shadow"), Shows("shadows of all lights"), Keys("ctrl+a"), Text("bounding"), Shows("bounding boxes of whole")],
            [Hides("shadows of all lights"), Keys("Escape"), Hides("bounding boxes of whole"), FrameIsAsBefore]),
        new("axis gizmo", "scene.sdo", [ClickAt(883, 73)], [FrameDiffers(0.005), Keys("ctrl+z"), FrameIsAsBefore]),
        new("search in the keys, and run", "scene.sdo",
            [Keys("h"), Text("wirefr"), Hides("Frame the scene"), Click("wireframe", right: -116)], [FrameDiffers(0.005), Hides("search")]),
        new("an action without a key, from the list of keys", "scene.sdo",
            [Keys("h"), Text("boxes"), Click("View menu")], [FrameDiffers(0.0005), Hides("search")]),
        new("key of the settings", "scene.sdo",
            [Keys("g"), FrameIsAsBefore, Keys("ctrl+g")], [FrameDiffers(0.002), Keys("h"), Text("grid"), Shows("Ctrl+G")])
        {
            Settings = "key grid Ctrl+G\n",
        },
        new("menu by the mouse", "scene.sdo", [Click("View"), Click("Wireframe")], [FrameDiffers(0.005)]),
        new("menu by the keyboard", "scene.sdo", [Keys("F10 Right Right Down"), Shows("Frame the scene"), Keys("Escape")],
            [Hides("Wireframe")]),
        new("tooltip", "scene.sdo", [Keys("F3"), PointAt("Occlusion culling")], [Shows("the image is the same")]),
        new("larger and smaller text", "scene.sdo",
            [Keys("ctrl+plus")], [SettingsHave("scale 1.25"), Keys("ctrl+minus"), SettingsHave("scale 1\n".TrimEnd())]),
        new("light colours", "scene.sdo", [Keys("ctrl+l")], [SettingsHave("theme light"), FrameIsAsBefore]),
        // Without a window manager the window itself stays as it is, and its frame does not shrink again.
        new("full screen", "scene.sdo", [Keys("F11"), IsLarger], [Keys("F11"), Title("scene.sdo -")]),
        new("hide all panels", "scene.sdo",
            [Keys("F2"), Shows("Objects"), Keys("u"), Hides("Objects"), Hides("File")], [Keys("u"), Shows("Objects"), Shows("File")]),
        new("open a file that is missing", "scene.sdo",
            [Keys("ctrl+o ctrl+u"), Text("nothing.sdo"), Keys("Return")],
            [Shows("there is no such file"), Keys("Escape"), FrameIsAsBefore]),
        new("open completed by Tab", "scene.sdo", [Keys("ctrl+o ctrl+u"), Text("ro"), Keys("Tab Return")], [Title("row.fdo -")]),
        new("save as a name that is taken", "scene.sdo",
            [Keys("ctrl+shift+s ctrl+u"), Text("two.sdo"), Keys("Return")], [Shows("exists already"), Keys("Escape"), Title("scene.sdo")]),
        new("save as a new scene", "row.fdo",
            [Keys("ctrl+shift+s ctrl+u"), Text("fresh"), Keys("Return")], [Title("fresh.sdo"), FileHas("o \"row.fdo\"", "fresh.sdo")]),
        new("save as leaves the edited scene as it was", "scene.sdo",
            [Keys("F2"), Type("0.9", "Background", 0, 3, 1), Title("scene.sdo*"), FrameDiffers(0.5), Keys("ctrl+shift+s ctrl+u"),
                Text("fresh.sdo"), Keys("Return"), Title("fresh.sdo -")],
            [FileHas("\nbackground (0.9, ", "fresh.sdo"), FileIs(SceneText)]),
        new("a number typed while a file loads is kept", "scene.sdo",
            [Keys("F2 ctrl+o ctrl+u"), Text("large.obj"), OpenAndType("0.9", "Background"), Reports("large.obj was not opened")],
            [Title("scene.sdo*"), FrameDiffers(0.5), FileIs(SceneText)])
        {
            NeedsLargeFile = true,
        },
        new("close is cancelled", "scene.sdo",
            [Keys("F2"), Type("0.9", "Background", 0, 3, 1), Title("scene.sdo*"), Keys("Escape"), Shows("save first"), Keys("Escape")],
            [Hides("save first"), Title("scene.sdo*"), FileIs(SceneText)]),
        new("save first, then close", "scene.sdo",
            [Keys("F2"), Type("0.9", "Background", 0, 3, 1), Title("scene.sdo*"), FrameDiffers(0.5), Keys("Escape"), Shows("save first"),
                Keys("s")],
            [Exits, FileHas("\nbackground (0.9, ")]),
        new("look by the right button", "scene.sdo", [Drag(500, 400, 560, 400, button: 3)],
            [FrameDiffers(0.005), Keys("ctrl+z"), FrameIsAsBefore]),
        new("pan by the middle button", "scene.sdo", [Drag(500, 400, 560, 400, button: 2)],
            [FrameDiffers(0.005), Keys("ctrl+z"), FrameIsAsBefore]),
        new("orbit by the left button", "scene.sdo", [Drag(500, 450, 560, 450)], [FrameDiffers(0.002), Keys("ctrl+z"), FrameIsAsBefore]),
        new("zoom by the wheel", "scene.sdo", [Wheel(450, 350, 4)], [FrameDiffers(0.01), Keys("Return"), FrameIsAsBefore]),
        new("statistics", "row.fdo", [Keys("i")], [Shows("draw time"), Shows("occlusion culling"), Keys("i"), Hides("draw time")]),
        new("Tab and Enter type into a slider", "scene.sdo",
            [Keys("F2"), Click("left"), ClickColumn("position", 0, 3, 1), Keys("Tab Return ctrl+a"), Text("1.5"), Keys("Return"), Save()],
            [FileHas("((0, 1.5, 0), #, #) name \"left\"")]),
        new("copy the camera", "scene.sdo", [Keys("ctrl+shift+c")], [ClipboardHas("c (0, 0, -8) (0, 0, 0) 60")]),
        new("screenshot of the window", "scene.sdo", [Keys("ctrl+F12")], [Reports("saved out")]),
    ];
}
