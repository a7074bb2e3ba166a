using System.Text;
using FractalEngine.Parsing.Sdo;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.App.Window;

/// <summary>Saves from a driven window while the file is edited elsewhere.</summary>
[Collection(DrivenWindow.Collection)]
public sealed class SavingTests : IDisposable
{
    private const string Warning = "missing.mtl";
    private const string CameraLine = "c (2, 1.5, -3) (0.3, 0.6, 0) 60";
    private const string Scene = $"# kept\n{CameraLine}\n\t o \"cube.obj\"   #  \n";

    private readonly TemporaryFolder _folder = new();

    public SavingTests()
    {
        _folder.Write("cube.obj", "mtllib missing.mtl\nusemtl missing\n" + SampleFiles.Cube);
        _folder.Write("scene.sdo", Scene);
    }

    public void Dispose() => _folder.Dispose();

    [SkippableTheory]
    [InlineData("\r\n", "utf-8")]
    public void Save_WhileAnEditorHasAddedLines_ChangesOnlyTheCamera(string lineBreak, string encoding)
    {
        using var window = Open("--no-watch");
        window.Send("key 3");
        var edited = string.Join(
            lineBreak, "# größer", CameraLine, "# kept  ", "o \"cube.obj\" #", "o \"cube.obj\" ((3, 0, 0), #, #)");
        File.WriteAllText(_folder["scene.sdo"], edited, Encoding.GetEncoding(encoding));
        window.Send("key ctrl+s");
        window.WaitForError("saved scene.sdo");
        var saved = File.ReadAllText(_folder["scene.sdo"]);
        Assert.Equal(edited.Split(lineBreak).Where((_, i) => i != 1), saved.Split(lineBreak).Where((_, i) => i != 1));
        Assert.StartsWith("c (", saved.Split(lineBreak)[1], StringComparison.Ordinal);
        Assert.NotEqual(CameraLine, saved.Split(lineBreak)[1]);
        Assert.Equal(0, window.CloseWith("key Escape"));
    }

    [SkippableTheory]
    [InlineData("\n", "utf-8")]
    [InlineData("\n", "utf-16")]
    [Trait("Category", "Soak")]
    public void Save_WhileAnEditorHasAddedLinesInOtherCases_ChangesOnlyTheCamera(string lineBreak, string encoding) =>
        Save_WhileAnEditorHasAddedLines_ChangesOnlyTheCamera(lineBreak, encoding);

    [SkippableTheory]
    [InlineData("k", false)]
    [InlineData("t", true)]
    public void Save_WhereBothChangedTheCamera_Asks(string answer, bool isTheirs)
    {
        const string theirs = "c (9, 9, 9) (0.1, 0.2, 0) 33";
        using var window = Open("--no-watch");
        window.Send("key 3");
        var edited = Scene.Replace(CameraLine, theirs, StringComparison.Ordinal);
        _folder.Write("scene.sdo", edited);
        window.Send("key ctrl+s");
        window.Screenshot();
        Assert.Equal(edited, File.ReadAllText(_folder["scene.sdo"]));
        window.Send($"key {answer}");
        window.WaitForError(isTheirs ? "took the view of scene.sdo" : "saved scene.sdo");
        Assert.Equal(isTheirs, File.ReadAllText(_folder["scene.sdo"]) == edited);
        Assert.Single(File.ReadAllLines(_folder["scene.sdo"]), line => line.StartsWith("c ", StringComparison.Ordinal));
        Assert.Equal(0, window.CloseWith("key Escape"));
    }

    [SkippableFact]
    public void Save_OfAModel_AsksForANameAndReplacesNothing()
    {
        _folder.Write("cube.sdo", "# another scene\n");
        using var window = Open("cube.obj", []);
        window.Send("key 3 key ctrl+s");
        window.Send("key Return");
        window.WaitForError("saved cube-2.sdo");
        Assert.Equal("# another scene\n", File.ReadAllText(_folder["cube.sdo"]));
        Assert.NotNull(SceneParser.Parse(new("cube-2.sdo", File.ReadAllText(_folder["cube-2.sdo"]))).Scene.Camera);
        // From now on the window shows the new scene, and saves into it.
        window.WaitForTitle("cube-2.sdo");
        window.Send("key 1 key ctrl+s");
        Polling.WaitUntil(() => window.CountErrors("saved cube-2.sdo") > 1, "second save");
        window.Send("key ctrl+shift+s key ctrl+u");
        window.Type("cube.sdo");
        window.Send("key Return");
        window.Send("key ctrl+u");
        window.Type("other");
        window.Send("key Return");
        window.WaitForError("saved other.sdo");
        Assert.Equal("# another scene\n", File.ReadAllText(_folder["cube.sdo"]));
        Assert.Equal(0, window.CloseWith("key Escape"));
    }

    [SkippableFact]
    public void Copy_OfTheCamera_IsALineThatAQuestionTakes()
    {
        using var window = Open();
        window.Send("key ctrl+shift+c key ctrl+shift+s key ctrl+u key ctrl+v");
        window.Type(".sdo");
        window.Send("key Return");
        window.WaitForError("saved c (");
        var saved = Assert.Single(Directory.GetFiles(_folder.Path, "c (*"));
        Assert.Equal($"{CameraLine}.sdo", Path.GetFileName(saved));
        Assert.Equal(0, window.CloseWith("key Escape"));
    }

    [SkippableFact]
    public void Close_WithChanges_Asks()
    {
        using var window = Open();
        window.Send("key 3 key Escape");
        window.Send("key Escape");
        window.Screenshot();
        Assert.False(window.HasExited);
        Assert.Equal(0, window.CloseWith("key Escape key s"));
        Assert.DoesNotContain(CameraLine, File.ReadAllText(_folder["scene.sdo"]), StringComparison.Ordinal);
    }

    [SkippableFact]
    [Trait("Category", "Soak")]
    public void Save_IntoAFolderThatIsGone_SaysSo()
    {
        var inner = Path.Combine(_folder.Path, "inner");
        _folder.Write("inner/cube.obj", File.ReadAllText(_folder["cube.obj"]));
        _folder.Write("inner/scene.sdo", Scene);
        using var window = Open("inner/scene.sdo", ["--no-watch"]);
        window.Send("key 3");
        Directory.Delete(inner, recursive: true);
        window.Send("key ctrl+s");
        window.WaitForError("is gone");
        Assert.False(Directory.Exists(inner));
        Assert.Equal(0, window.CloseWith("key Escape key d"));
    }

    private DrivenWindow Open(params string[] options) => Open("scene.sdo", options);

    private DrivenWindow Open(string file, string[] options)
    {
        var window = DrivenWindow.OpenInLowQuality(_folder, file, options);
        window.WaitForError(Warning);
        return window;
    }
}
