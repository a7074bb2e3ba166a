using static FractalEngine.Tests.App.Window.Interactions.Scenario;

namespace FractalEngine.Tests.App.Window.Interactions;

/// <content>Saves and loads that overtake each other. None of them may lose an edit.</content>
internal static partial class InteractionTable
{
    private static IEnumerable<Interaction> OfRaces =>
    [
        new("save a number, then the view, while another file loads", "scene.sdo",
            [
                Keys("F2"), OpenAllAndTypeAtOnce(["large.obj"], "0.9", "Background", "ctrl+s 5 ctrl+s"),
                Reports("large.obj was not opened"), Reports("saved scene.sdo"),
            ],
            [Title("scene.sdo -"), FileHas("\nbackground (0.9"), FileHas("\nprojection orthographic")])
        {
            NeedsLargeFile = true,
        },
        new("save as another at once after an undo", "scene.sdo",
            [
                Keys("F2"), Type("0.9", "Background", 0, 3, 1), Title("scene.sdo*"), FrameDiffers(0.2),
                AtOnce("ctrl+z ctrl+shift+s Return"), Reports("saved scene-2.sdo"),
            ],
            [Title("scene-2.sdo -"), FileLacks("background", "scene-2.sdo"), FrameIsAsBefore]),
        new("save as another at once after a number", "scene.sdo",
            [
                Keys("F2"), Click("left"), ClickColumn("position", 0), AtOnce("ctrl+a 0 period 5 Return ctrl+shift+s Return"),
                Reports("saved scene-2.sdo"),
            ],
            [Title("scene-2.sdo -"), FileHas("((0.5, 0, 0), #, #) name \"left\"", "scene-2.sdo"), FileIs(SceneText)]),
        new("a number while several files load", "scene.sdo",
            [
                Keys("F2"), Click("left"), OpenAllAndTypeAtOnce(["large.obj", "row.fdo"], "0.5", "position"),
                Reports("large.obj was not opened"), Reports("row.fdo was not opened"),
            ],
            [Title("scene.sdo*"), FrameDiffers(0.002), Save(), FileHas("((0.5, 0, 0), #, #) name \"left\"")])
        {
            NeedsLargeFile = true,
        },
        new("save a number and the view where an editor moved the camera", "scene.sdo",
            [
                Keys("F2"), Click("left"), Type("0.5", "position", 0, 3, 1), Title("scene.sdo*"), Keys("3"),
                Replace("c (0, 0, -8) (0, 0, 0) 60", "c (1, 2, -9) (0, 0, 0) 60\nbackground (0.9, 0, 0)"), FrameDiffers(0.5),
                Keys("ctrl+s"), Shows("has changed in the same"),
            ],
            [
                FileHas("((0.5, 0, 0), #, #) name \"left\""), FileHas("\nc (1, 2, -9) (0, 0, 0) 60\n"), Keys("k"),
                ReportsTimes("saved scene.sdo", 2), FileLacks("c (1, 2, -9)"), FileHas("\nbackground (0.9, 0, 0)\n"),
            ]),
        new("the same without watching", "scene.sdo",
            [
                Keys("F2"), Click("left"), Type("0.5", "position", 0, 3, 1), Title("scene.sdo*"), Keys("3"),
                Replace("c (0, 0, -8) (0, 0, 0) 60", "c (1, 2, -9) (0, 0, 0) 60"), Keys("ctrl+s"), Shows("has changed in the same"),
            ],
            [
                FileHas("((0.5, 0, 0), #, #) name \"left\""), FileHas("\nc (1, 2, -9) (0, 0, 0) 60\n"), Keys("k"),
                ReportsTimes("saved scene.sdo", 2), FileLacks("c (1, 2, -9)"), FileHas("((0.5, 0, 0), #, #) name \"left\""),
            ])
        {
            Options = ["--no-watch"],
        },
        new("numbers of a vector and of a colour at once", "scene.sdo",
            [
                Keys("F2"), Click("left"), TypeAtOnce("position", "0.5", "0.25", "0.75"), TypeAtOnce("Background", "0.9", "0.8", "0.7"),
                Title("scene.sdo*"), FrameDiffers(0.2), Save(),
            ],
            [FileHas("((0.5, 0.25, 0.75), #, #) name \"left\""), FileHas("\nbackground (0.9, 0.8, 0.7)\n")]),
        new("undo a duplicate after the view was saved", "scene.sdo",
            [
                Keys("F2"), Click("left"), Click("Duplicate"), Shows("Objects (3)"), Save(), Keys("5 ctrl+s"),
                ReportsTimes("saved scene.sdo", 2), Title("scene.sdo -"),
            ],
            [
                Keys("ctrl+z ctrl+z"), Shows("Objects (2)"), Title("scene.sdo*"), Save(), FileLacks("projection orthographic"),
                FileLacks("((0.25, 0, 0)"),
            ]),
        new("save what was typed, then what was typed meanwhile", "scene.sdo",
            [
                Keys("F2"), Type("0.9", "Background", 0, 3, 1), Title("scene.sdo*"), FrameDiffers(0.2),
                AtOnce("ctrl+s 5 ctrl+s 3 ctrl+s ctrl+z ctrl+s"), ReportsTimes("saved scene.sdo", 4),
            ],
            [
                FileHas("\nbackground (0.9"), FileHas("\nprojection orthographic"), FileHas("c (0, 0, -8) (0, 0, 0) 60\n"),
                Title("scene.sdo -"),
            ]),
    ];
}
