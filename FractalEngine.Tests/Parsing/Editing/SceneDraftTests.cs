using FractalEngine.Core.Maths;
using FractalEngine.Parsing.Assets;
using FractalEngine.Parsing.Editing;
using FractalEngine.Parsing.Sdo;
using FractalEngine.Parsing.Sdo.Merging;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Parsing.Editing;

/// <summary>Saves of numbers and of the view in any order, while the file is being loaded again.</summary>
public sealed class SceneDraftTests : IDisposable
{
    private const string Red = "background (1, 0, 0)";
    private const string Green = "background (0, 1, 0)";
    private const string CameraLine = "c (0, 0, -8) (0, 0, 0) 60";
    private const string Text = $"# kept\n{CameraLine}\n{Red}\no \"cube.obj\" #\n";

    private readonly TemporaryFolder _folder = new();
    private readonly string _path;

    public SceneDraftTests()
    {
        _folder.Write("cube.obj", SampleFiles.Cube);
        _path = _folder.Write("scene.sdo", Text);
    }

    public void Dispose() => _folder.Dispose();

    [Fact]
    public void Save_OfTheViewBeforeSavedNumbersAreLoaded_KeepsThem()
    {
        var (draft, view) = Load();
        var numbers = Text.Replace(Red, Green, StringComparison.Ordinal);
        EditedFileWriter.Write(_path, new(Text, numbers));
        draft = draft.Saved(numbers, view);
        draft = SaveView(draft, Moved(view, 1));
        Assert.Equal(numbers.Replace(CameraLine, "c (1, 0, -8) (0, 0, 0) 60", StringComparison.Ordinal), File.ReadAllText(_path));
        // Back to the camera of the loaded text, which the file does not have any more.
        draft = SaveView(draft, view);
        Assert.Equal(numbers, File.ReadAllText(_path));
    }

    [Fact]
    public void Save_OfNumbersAfterTheView_WritesTheViewThatIsShown()
    {
        var (draft, view) = Load();
        draft = SaveView(draft, Moved(view, 1));
        var text = File.ReadAllText(_path);
        Assert.Equal(Text, draft.TryWriteInto(view, text));
        Assert.Contains("c (2, 0, -8)", draft.TryWriteInto(Moved(view, 2), text), StringComparison.Ordinal);
        // An editor has moved the camera too: that is for the user to decide.
        Assert.Null(draft.TryWriteInto(view, text.Replace("c (1", "c (7", StringComparison.Ordinal)));
    }

    [Fact]
    public void Saves_AndReloadsInAnyOrder_LoseNoEdit()
    {
        for (var seed = 0; seed < 50; seed++)
        {
            var random = new Random(seed);
            File.WriteAllText(_path, Text);
            var (draft, view) = Load();
            var (lastX, lastBlue) = (0, 0.0);
            for (var step = 0; step < 8; step++)
            {
                switch (random.Next(4))
                {
                    case 0:
                        view = Moved(view, lastX = random.Next(5));
                        draft = SaveView(draft, view);
                        break;
                    case 1:
                        lastBlue = random.Next(1, 9) / 10.0;
                        draft = SaveBlue(draft, view, lastBlue);
                        lastX = (int)view.Camera.Position.X;
                        break;
                    case 2:
                        // A move that is not saved at once.
                        view = Moved(view, random.Next(5));
                        break;
                    default:
                        var file = AssetLoader.Load(_path);
                        draft = draft.Rebase(file, ViewOf(file), view);
                        break;
                }
            }

            var scene = SceneParser.Parse(new("scene.sdo", File.ReadAllText(_path))).Scene;
            Assert.True(
                scene.Camera!.Position.X == lastX && scene.Background!.Value.Blue == lastBlue, $"seed {seed}: {File.ReadAllText(_path)}");
        }
    }

    [Fact]
    public void Write_WhileAnotherProgramWrites_KeepsBoth()
    {
        var isFirst = true;
        EditedFileWriter.Write(_path, new(Text, Text.Replace(Red, Green, StringComparison.Ordinal)), text =>
        {
            if (isFirst)
            {
                isFirst = false;
                File.WriteAllText(_path, Text.Replace("# kept", "# written meanwhile", StringComparison.Ordinal));
            }

            return text;
        });
        Assert.Equal(
            Text.Replace("# kept", "# written meanwhile", StringComparison.Ordinal).Replace(Red, Green, StringComparison.Ordinal),
            File.ReadAllText(_path));
    }

    [Fact]
    public void Edits_ThatAreInTheFileAlready_AreNoneWithoutAMessage()
    {
        var edits = FileEdits.None.With(_path, Text.Replace(Red, Green, StringComparison.Ordinal));
        var text = Text.Replace(Red, Green, StringComparison.Ordinal);
        File.WriteAllText(_path, text.Replace(CameraLine, "c (1, 0, -8) # 60", StringComparison.Ordinal));
        var messages = new List<string>();
        Assert.True(edits.Rebase(messages.Add).IsEmpty);
        Assert.Empty(messages);
    }

    private (SceneDraft Draft, SceneView View) Load()
    {
        var file = AssetLoader.Load(_path);
        return (new(file, ViewOf(file)), ViewOf(file));
    }

    private static SceneView ViewOf(LoadedFile file) =>
        new(file.Scene.Scene.Camera!, file.Scene.Scene.Projection, file.Scene.Scene.OrthographicHeight);

    private static SceneView Moved(SceneView view, double x) =>
        view with { Camera = view.Camera with { Position = new Vector(x, 0, -8) } };

    private SceneDraft SaveView(SceneDraft draft, SceneView view)
    {
        var merged = SceneFileMerge.Write(_path, draft.SavedText, draft.Write(view));
        Assert.Empty(merged.Conflicts);
        return draft.Saved(merged.Text, view);
    }

    /// <summary>Saves a number and the view, as Ctrl+S does after a number was changed.</summary>
    private SceneDraft SaveBlue(SceneDraft draft, SceneView view, double blue)
    {
        var before = File.ReadAllText(_path);
        var edited = SceneEditor.Change(before, scene => scene with { Background = new(1, 0, blue) });
        EditedFileWriter.Write(_path, new(before, edited), text =>
        {
            var written = draft.TryWriteInto(view, text);
            Assert.NotNull(written);
            return written;
        });
        return draft.Saved(draft.Carry(view, edited), view);
    }
}
