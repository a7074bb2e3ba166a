using FractalEngine.App.Window.State;
using FractalEngine.Core.Scenes.Cameras;
using FractalEngine.Parsing.Assets;
using FractalEngine.Parsing.Editing;
using FractalEngine.Render.Cameras;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.App.Window.State;

/// <summary>Opens, edits, saves and loads that overtake each other, without a window.</summary>
public sealed class WindowStateTests : IDisposable
{
    private const string Scene = "c (0, 0, -8) (0, 0, 0) 60\no \"cube.obj\" #\n";
    private const string Red = Scene + "background (1, 0, 0)\n";
    private const string Green = Scene + "background (0, 1, 0)\n";

    private static readonly TimeSpan Start = TimeSpan.FromSeconds(5);
    private static readonly TimeSpan Later = TimeSpan.FromSeconds(6);

    private readonly TemporaryFolder _folder = new();

    // Files by the paths under which they are opened.
    private readonly Dictionary<string, LoadedFile> _files;

    public WindowStateTests()
    {
        _folder.Write("cube.obj", SampleFiles.Cube);
        _files = new[] { _folder.Write("scene.sdo", Scene), _folder.Write("copy.sdo", Scene), _folder["cube.obj"] }
            .ToDictionary(static path => path, static path => AssetLoader.Load(path));
    }

    private string Path => _folder["scene.sdo"];

    private string Other => _folder["cube.obj"];

    public void Dispose() => _folder.Dispose();

    [Fact]
    public void Open_OfTheFirstFile_LoadsAndShowsIt()
    {
        var loading = new WindowState().Open(Path);
        Assert.Equal((Path, false, true), (loading.FilePath, loading.Loading!.Continues, loading.IsBusy));
        var loaded = End(loading);
        Assert.Equal((null, Path), (loaded.Loading, loaded.Showing!.Path));
        Assert.Null(loaded.Document);
        var shown = Show(loaded);
        Assert.Equal((null, null, false), (shown.Loading, shown.Showing, shown.IsBusy));
        Assert.Equal([(WindowEffect.WatchFiles, "")], shown.Effects.AsEnumerable());
        Assert.True(shown.Edits.IsEmpty);
    }

    [Fact]
    public void Open_OfAFirstFileThatIsBroken_ShowsWhyUntilItIsMended()
    {
        var refused = End(new WindowState().Open(Path), "broken");
        Assert.Equal(("broken", false), (refused.Error, refused.IsBusy));
        Assert.Equal([(WindowEffect.Print, "broken"), (WindowEffect.WatchFiles, "")], refused.Effects.AsEnumerable());
        var again = (refused with { Effects = [] }).FilesChanged();
        Assert.Equal((Path, false), (again.Loading!.Path, again.Loading.Continues));
        // Each attempt is reported.
        Assert.Equal((WindowEffect.Print, "broken"), End(again, "broken").Effects[0]);
        Assert.Null(Show(End(again)).Error);
    }

    [Fact]
    public void Open_WhileAnotherLoads_ComesNextAndTheLastWins()
    {
        var loading = Shown().Open(Other).Open("second").Open("third");
        Assert.Equal((Other, "third"), (loading.Loading!.Path, loading.Next!.Path));
        var next = Show(End(loading));
        Assert.Equal((Other, "third", null), (next.FilePath, next.Loading!.Path, next.Next));
    }

    [Fact]
    public void Open_OfABrokenFile_LeavesTheDocumentAndItsPath()
    {
        var refused = End(Shown().Open(Other), "broken");
        Assert.Equal((Path, null, null, false), (refused.FilePath, refused.Error, refused.Fault, refused.IsBusy));
        // The files of the document are watched further, not those of the other.
        Assert.Equal([(WindowEffect.ShowProblem, "broken")], refused.Effects.AsEnumerable());
    }

    [Fact]
    public void Open_OfWhatTheDriverRefuses_LeavesTheDocumentAndGoesOn()
    {
        var loaded = End(Shown().Open(Other).Open("next"));
        Assert.Null(loaded.Loading);
        var refused = loaded.Refused("too large", Start);
        Assert.Equal((Path, null, "next"), (refused.FilePath, refused.Showing, refused.Loading!.Path));
        Assert.Equal([(WindowEffect.ShowProblem, "too large")], refused.Effects.AsEnumerable());
    }

    [Fact]
    public void Open_WhileTheDocumentIsEdited_IsReportedAndKeepsTheEdit()
    {
        var kept = End(Edit(Shown().Open(Other), Red));
        Assert.Equal([(WindowEffect.Report, "cube.obj was not opened, since scene.sdo was changed meanwhile: save that first")],
            kept.Effects.AsEnumerable());
        Assert.Null(kept.Showing);
        Assert.True(kept.IsReload(kept.Loading!));
        Assert.Equal(Red, kept.Document!.SceneText(kept.EditsToLoad));
    }

    [Fact]
    public void Open_AfterTheEditsWereDiscarded_ShowsTheFileWithoutThem()
    {
        var shown = Show(End(Show(End(Edit(Shown(), Red))).Open(Path)));
        Assert.True(shown.Edits.IsEmpty && shown.Document!.ShownEdits.IsEmpty);
        Assert.Null(shown.Document!.Undo(isRedo: false));
    }

    [Fact]
    public void Open_OfTheSameFileBehindAnEdit_IsReportedAndShowsTheEdit()
    {
        var state = Edit(Begin(Shown().Reload()).Open(Path), Red);
        var opening = Show(state.Ended(null, Start));
        Assert.Equal((Path, false, true), (opening.Loading!.Path, opening.Loading.Continues, opening.NeedsReload));
        var kept = End(opening);
        Assert.Equal(WindowEffect.Report, kept.Effects[^1].Effect);
        Assert.False(Show(End(kept)).Document!.HasUnshownEdit);
    }

    [Fact]
    public void Shown_OfAnotherFile_DropsWhatWaitsForTheDocumentBefore()
    {
        var state = (Shown().Open(Other) with { AfterLoad = static () => { } }).Reload();
        var shown = Show(End(state));
        Assert.Equal((Other, null, false, null), (shown.FilePath, shown.Loading, shown.NeedsReload, shown.AfterLoad));
    }

    [Fact]
    public void Edit_UntilItIsShown_IsNotKnownToLoad()
    {
        var edited = Edit(Shown(), Red);
        Assert.True(edited.IsEditLoading && edited.Document!.HasUnshownEdit);
        var again = Edit(edited, Green);
        Assert.True(again.NeedsReload);
        var first = Show(End(again));
        // What had not begun when it was edited once more has the second edit already.
        Assert.Equal(Green, first.Document!.SceneText(first.Document.ShownEdits));
        var second = Show(End(first));
        Assert.False(second.IsEditLoading || second.NeedsReload || second.IsBusy);
    }

    [Fact]
    public void Edit_WhileTheOneBeforeLoads_IsLoadedNext()
    {
        var edited = Edit(Begin(Edit(Shown(), Red)), Green);
        var first = Show(edited.Ended(null, Start));
        Assert.Equal(Red, first.Document!.SceneText(first.Document.ShownEdits));
        Assert.True(first.IsEditLoading);
        Assert.False(Show(End(first)).IsEditLoading);
    }

    [Fact]
    public void Edit_OfTheSameInteraction_IsOneStep()
    {
        var edited = Edit(Edit(Shown(), Red, interaction: 1), Green, interaction: 1);
        Assert.True(edited.Document!.Record(View(0)).Undo(isRedo: false)!.Edits.IsEmpty);
        var apart = Edit(Edit(Shown(), Red, interaction: 1), Green, interaction: 2).Document!;
        Assert.Equal(Red, apart.SceneText(apart.Record(View(0)).Undo(isRedo: false)!.Edits));
    }

    [Fact]
    public void Started_AfterAnotherProgramHasChangedTheFile_TakesTheRebasedEdits()
    {
        var edited = Edit(Shown(), Red);
        var started = edited.Started(FileEdits.None);
        Assert.True(started.Edits.IsEmpty && started.Loading!.Edits.IsEmpty);
        // Another file has nothing of the document's edits.
        var opened = Show(End(edited)).Open(Other);
        Assert.True(opened.EditsToLoad.IsEmpty);
        Assert.Equal(Red, opened.Document!.SceneText(opened.Started(opened.EditsToLoad).Edits));
    }

    [Fact]
    public void Saved_WhileTheDocumentLoads_LoadsItAgain()
    {
        var saving = Begin(Shown().Reload());
        var ended = saving.Saved(saving.Document!).Ended(null, Start);
        Assert.True(ended.Showing is null && ended.IsReload(ended.Loading!));
        // What has failed may have been older, too.
        Assert.Null(saving.Saved(saving.Document!).Ended("broken", Start).Fault);
        // Before the load has begun it does not matter.
        var due = Shown().Reload();
        Assert.NotNull(End(due.Saved(due.Document!)).Showing);
    }

    [Fact]
    public void Saved_WhileTheFileIsOpenedAgain_OpensItOnceMore()
    {
        var opening = Begin(Shown().Open(Path));
        var ended = opening.Saved(opening.Document!).Ended(null, Start);
        Assert.Equal((null, Path, false), (ended.Showing, ended.Loading!.Path, ended.Loading.Continues));
        // A file that was asked for meanwhile comes instead.
        Assert.Equal(Other, opening.Saved(opening.Document!).Open(Other).Ended(null, Start).Loading!.Path);
        // Another file has nothing to do with the save.
        var other = Begin(Shown().Open(Other));
        Assert.NotNull(other.Saved(other.Document!).Ended(null, Start).Showing);
    }

    [Fact]
    public void Saved_UnderAnotherName_ContinuesThereWithoutTheEditsOfTheScene()
    {
        var edited = Show(End(Edit(Shown(), Red)));
        var withOther = edited with { Document = edited.Document! with { Edits = edited.Edits.With(Other, "# other") } };
        var opening = withOther.Open(_folder["copy.sdo"], continues: true);
        Assert.True(opening.Loading!.Continues && opening.IsEditLoading);
        Assert.True(Begin(Shown().Reload()).Open("copy.sdo", continues: true).IsEditLoading);
        var shown = Show(End(opening));
        Assert.Equal([Other], shown.Edits.Files.Keys);
        Assert.Equal((_folder["copy.sdo"], false), (shown.FilePath, shown.IsEditLoading));
    }

    [Fact]
    public void Saved_UnderAnotherNameAndEditedMeanwhile_IsReported()
    {
        var opening = Edit(Begin(Shown().Open(_folder["copy.sdo"], continues: true)), Red);
        Assert.Equal(WindowEffect.Report, Assert.Single(opening.Ended(null, Start).Effects).Effect);
    }

    [Fact]
    public void Fault_OfTheDocument_IsShownAfterAWhile()
    {
        var faulty = End(Shown().FilesChanged(), "broken");
        Assert.Equal((null, true), (faulty.Error, faulty.IsBusy));
        Assert.Equal([(WindowEffect.WatchFiles, "")], faulty.Effects.AsEnumerable());
        Assert.Same(faulty, faulty.Tick(Start));
        var loading = faulty.Reload();
        Assert.Same(loading, loading.Tick(Later));
        Assert.Null(faulty.FilesChanged().Fault);
        var shown = (faulty with { Effects = [] }).Tick(Later);
        Assert.Equal(("broken", false), (shown.Error, shown.IsBusy));
        Assert.Equal([(WindowEffect.Print, "broken")], shown.Effects.AsEnumerable());
        // The same reason is printed once, and goes when the file is mended.
        var again = End((shown with { Effects = [] }).FilesChanged(), "broken") with { Effects = [] };
        Assert.Empty(again.Tick(Later).Effects);
        Assert.Null(Show(End(shown.FilesChanged())).Error);
    }

    [Fact]
    public void Fault_OfAnEdit_DropsTheEditIfTheSceneLoadsWithoutIt()
    {
        var first = Show(End(Edit(Shown(), Red)));
        var edited = Edit(first, Green) with { AfterLoad = static () => { }, Effects = [] };
        edited = edited with { Document = edited.Document!.Record(View(3)) };
        var faulty = End(edited, "broken");
        Assert.True(faulty.IsEditLoading);
        var trial = faulty.Tick(Later);
        Assert.True(trial.IsEditLoading);
        // With the edit that is shown already.
        Assert.Equal(Red, trial.Document!.SceneText(trial.EditsToLoad));
        var ended = End(trial);
        Assert.Equal((WindowEffect.ShowProblem, "broken"), ended.Effects[^1]);
        Assert.Null(ended.AfterLoad);
        var shown = Show(ended);
        Assert.Equal(Red, shown.Document!.SceneText(shown.Edits));
        Assert.False(shown.IsEditLoading);
        // An undo does not return to it either.
        Assert.Equal(Red, shown.Document.SceneText(shown.Document.Record(View(4)).Undo(isRedo: false)!.Edits));
    }

    [Fact]
    public void Fault_OfAFileOnTheDisk_KeepsTheEditAndIsShown()
    {
        var trial = End(Edit(Shown(), Red), "broken").Tick(Later) with { Effects = [] };
        var ended = End(trial, "broken elsewhere");
        Assert.Equal("broken", ended.Error);
        Assert.Equal([(WindowEffect.Print, "broken")], ended.Effects.AsEnumerable());
        Assert.Equal(Red, ended.Document!.SceneText(ended.Edits));
        Assert.Null(ended.Showing);
    }

    [Fact]
    public void Fault_OfAnEditThatWasEditedSince_DropsNothing()
    {
        var trial = Begin(End(Edit(Shown(), Red), "broken").Tick(Later));
        var ended = Edit(trial, Green).Ended(null, Later);
        Assert.Null(ended.Showing);
        Assert.Equal(Green, ended.Document!.SceneText(ended.EditsToLoad));
    }

    [Fact]
    public void Fault_WhileAnotherFileIsRefused_StillTriesWithoutTheEdit()
    {
        var faulty = End(Edit(Shown(), Red), "broken");
        var trial = End(faulty.Open(Other), "another").Tick(Later);
        Assert.NotNull(trial.Loading!.Refused);
    }

    [Fact]
    public void Fail_AfterAFileIsShown_StaysUntilTheNextIs()
    {
        var failed = (Shown() with { Effects = [] }).Fail("no memory");
        Assert.Equal(("no memory", (WindowEffect.Print, "no memory")), (failed.Error, Assert.Single(failed.Effects)));
        Assert.Null(Show(End(failed.Reload())).Error);
    }

    /// <summary>Whatever happens in whatever order, no edit is lost, and the window comes to rest with the last one in the scene.</summary>
    [Fact]
    public void Events_InRandomOrder_EndWithTheLastEditShown()
    {
        for (var seed = 0; seed < 500; seed++)
        {
            var random = new Random(seed);
            var state = Shown();
            LoadRequest? begun = null;
            for (var step = 0; step < 60; step++)
            {
                var now = Start + TimeSpan.FromSeconds(0.1 * step);
                // Edits that are refused are dropped, which other tests are about: here only other files are broken.
                var error = state.Loading is { Continues: false } && random.Next(2) == 0 ? "broken" : null;
                var canEnd = state.Loading is not null && ReferenceEquals(state.Loading, begun);
                var choice = random.Next(10);
                var next = choice switch
                {
                    6 or 7 => Edit(state, $"{Scene}background (0, 0, 0.{random.Next(1, 9)})\n", random.Next(3)),
                    0 => state.Reload(),
                    1 => state.FilesChanged(),
                    2 when state.Edits.IsEmpty => state.Open(random.Next(2) == 0 ? Path : Other),
                    3 => state.Saved(state.Document!),
                    4 => state.Tick(now),
                    5 when state.Loading is not null && !canEnd => Begin(state),
                    8 or 9 when canEnd => ShowIfLoaded(state.Ended(error, now)),
                    _ => state,
                };
                begun = choice == 5 ? next.Loading : begun;
                Assert.True(choice is 6 or 7 || next.Edits.Equals(state.Edits), $"seed {seed}: step {step} loses an edit");
                state = next;
            }

            var last = state.Edits;
            for (var load = 0; state.IsBusy; load++)
            {
                Assert.True(load < 10, $"seed {seed}: loads without end");
                state = state.Loading is null ? state.Tick(TimeSpan.MaxValue) : ShowIfLoaded(End(state));
            }

            Assert.True(
                state is { Next: null, NeedsReload: false, Showing: null, IsEditLoading: false } && state.Edits.Equals(last)
                && state.Document!.ShownEdits.Equals(last), $"seed {seed}");
        }
    }

    private static CameraState View(double x)
    {
        var camera = Camera.Default with { Position = new(x, 0, -8) };
        return new(new(camera, Projection.Perspective, null, 0), camera, 1, null);
    }

    private static WindowState Begin(WindowState state) => state.Started(state.EditsToLoad);

    /// <summary>Lets the load in progress begin and end.</summary>
    private static WindowState End(WindowState state, string? error = null) => Begin(state).Ended(error, Start);

    /// <summary>Shows what was loaded, as a document does.</summary>
    private WindowState Show(WindowState state)
    {
        var file = _files[state.Showing!.Path];
        var view = new SceneView(file.Scene.Scene.Camera ?? Camera.Default, Projection.Perspective, null);
        return state.Shown(state.Showing.Continues ? state.Document!.Continue(file, view, view).State
            : new(new(file, view), new(new(View(0), FileEdits.None))));
    }

    private WindowState ShowIfLoaded(WindowState state) => state.Showing is null ? state : Show(state);

    /// <summary>Returns the state of a window that shows a scene.</summary>
    private WindowState Shown() => Show(End(new WindowState().Open(Path))) with { Effects = [] };

    private static WindowState Edit(WindowState state, string text, int? interaction = null) =>
        state.Edit(View(0), state.Edits.With(state.Document!.File.Path, text), interaction);
}
