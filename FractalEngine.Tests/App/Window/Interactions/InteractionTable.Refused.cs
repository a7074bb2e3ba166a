using static FractalEngine.Tests.App.Window.Interactions.Scenario;

namespace FractalEngine.Tests.App.Window.Interactions;

/// <content>Edits of a scene that can't be kept, and saves of several edits.</content>
internal static partial class InteractionTable
{
    private static IEnumerable<Interaction> OfRefusedEdits =>
    [
        new("add a file that is missing", "scene.sdo",
            [Keys("F2"), Click("file (.obj, .fdo"), Text("nothing.obj"), Keys("Return"), Reports("scene.sdo:6:3: error: the file")],
            [Title("scene.sdo -"), FrameIsAsBefore, Keys("ctrl+z"), Shows("nothing to undo")]),
        new("change objects after one was missing", "scene.sdo",
            [
                Keys("F2"), Click("file (.obj, .fdo"), Text("nothing.obj"), Keys("Return"), Reports("nothing.obj"), Title("scene.sdo -"),
                Click("left"), Click("Remove"), Shows("Objects (1)"), Save(),
            ],
            [FileLacks("nothing.obj"), FileLacks("left"), FileHas("# between\no \"cube.obj\" ((3, 0, 0), #, #) name \"right\"\n")]),
        new("save at once what is missing", "scene.sdo",
            [Keys("F2"), Click("file (.obj, .fdo"), Text("nothing.obj"), Keys("Return ctrl+s"), Reports("nothing.obj")],
            [Title("scene.sdo -"), FileIs(SceneText), Keys("ctrl+s"), Reports("saved scene.sdo"), FileIs(SceneText)]),
        new("add a file with a quote in its name", "scene.sdo",
            [Keys("F2"), Click("file (.obj, .fdo"), Keys("a quotedbl b Return"), Shows("a name in a scene")],
            [Title("scene.sdo -"), Click("left"), Type("2", "scale", 0, 3, 1), Save(), FileHas("#, (2, 1, 1)) name \"left\"")]),
        new("numbers after one was refused", "scene.sdo",
            [
                Keys("F2"), Click("left"), Type("0", "scale", 0, 3, 1), Reports("scene.sdo:3:"), Type("2", "position", 1, 3, 1),
                Title("scene.sdo*"), Click("right"), Type("4", "position", 1, 3, 1), Save(),
            ],
            [FileHas("((0, 2, 0), #, #) name \"left\""), FileHas("((3, 4, 0), #, #) name \"right\""), Title("scene.sdo -")]),
        new("a quote in a name", "scene.sdo",
            [
                Keys("F2"), Click("left"), ClickColumn("name", 1, 2, 0), Keys("ctrl+a a quotedbl"), Shows("a name in a scene"),
                Keys("b Return"),
            ],
            [Title("scene.sdo*"), Save(), FileHas("name \"a\" colour")]),
        new("save a number and the view together", "scene.sdo",
            [Keys("F2"), Click("left"), Type("0.5", "position", 0, 3, 1), Title("scene.sdo*"), FrameDiffers(0.002), Keys("f 5"), Save()],
            [
                Title("scene.sdo -"), FileHas("((0.5, 0, 0), #, #) name \"left\""), FileHas("projection orthographic"),
                FileLacks("c (0, 0, -8)"),
                // All of it can be undone: the view in two steps, then the number.
                Keys("ctrl+z ctrl+z"), Title("scene.sdo -"), Keys("ctrl+z"), Title("scene.sdo*"), ClickAt(SkyX, SkyY), FrameIsAsBefore,
                Keys("ctrl+shift+z ctrl+shift+z ctrl+shift+z"), Title("scene.sdo -"), Keys("Escape"), Exits,
            ]),
        new("a sky taken away keeps its colours", "lit.sdo",
            [
                Keys("F2"), Click("Sky and haze"), Click("sky"), Shows("zenith"), Type("0.5", "zenith", 0, 3, 1), Shows("0.5"),
                Save("lit.sdo"), Title("lit.sdo -"), Click("sky"), Hides("zenith"), Save("lit.sdo"), Title("lit.sdo -"),
                FileLacks("\nsky", "lit.sdo"), Click("sky"), Shows("zenith"), Save("lit.sdo"),
            ],
            [FileHas("\nsky (0.5, 0.45, 0.75) (0.75, 0.82, 0.9)", "lit.sdo")]),
        new("a camera has no negative zeros", "scene.sdo",
            [Keys("3 ctrl+s"), Reports("saved scene.sdo")],
            [FileLacks("c (0, 0, -8)"), FileLacks("-0,"), FileLacks("-0)")]),
        new("an outline turns with its object", "spin.sdo",
            [Keys("space r F2"), Click("spinner"), Keys("Escape F6"), Shows("(1, 1, 1)"), Keys("space")],
            [Hides("(1, 1, 1)"), Shows("the whole object")]),
        new("save as where the models are outside", "scene.sdo",
            [Keys("ctrl+shift+s ctrl+u"), Text("inner/new.sdo"), Keys("Return"), Shows("outside the folder")],
            [FileIsMissing("inner/new.sdo"), Keys("Escape"), Title("scene.sdo -")]),
        new("export under a name without a format, or one that is taken", "row.fdo",
            [
                Keys("ctrl+e"), Shows("row.3mf"), Keys("Return"), Shows("an export ends in .obj"), Text(".xyz"), Hides("ends in .obj"),
                Keys("Return"), Shows("an export ends in .obj"), Keys("ctrl+u"), Text("cube.obj"), Keys("Return"),
                Shows("cube.obj exists already"), Keys("ctrl+u"), Text("row.stl --hight 80mm"), Keys("Return"), Shows("'--hight'"),
            ],
            [FileIsMissing("row.xyz"), FileIsMissing("row.stl"), Keys("Escape"), Hides("--hight"), Title("row.fdo -")]),
        new("export an open mesh for printing", "open.obj",
            [Keys("ctrl+e"), Click("open.3mf"), Reports("error: "), Shows("open")], [FileIsMissing("open.3mf"), FrameIsAsBefore]),
        new("save a number and the projection, then close", "scene.sdo",
            [Keys("F2"), Click("left"), Type("0.5", "position", 0, 3, 1), Title("scene.sdo*"), Keys("5"), Save(), Title("scene.sdo -")],
            [Keys("Escape Escape Escape"), Exits, FileHas("((0.5, 0, 0), #, #)"), FileHas("projection orthographic")]),
    ];
}
