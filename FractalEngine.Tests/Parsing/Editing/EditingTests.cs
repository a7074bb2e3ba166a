using FractalEngine.Core.Geometry;
using FractalEngine.Parsing.Assets;
using FractalEngine.Parsing.Editing;
using FractalEngine.Parsing.Fdo;
using FractalEngine.Parsing.Sdo.Merging;
using FractalEngine.Parsing.Text;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Parsing.Editing;

/// <summary>Tests edits of files in memory, without a window.</summary>
public sealed class EditingTests : IDisposable
{
    private const string Fractal =
        "# note\nv 1 2\t3.50\nv  0 ,60, 0 \nv 0.5 0.5 0.5\nv 9 9 9\n" +
        "t.a.b.c. (a, b, c)\nu.a. (a, #, 3)\nx. \"cube.obj\"\nz<x>. [#, t.1.2.3] x\ny<z>. [u.1] z\n<$>. z 12\n";

    private readonly TemporaryFolder _folder = new();

    public EditingTests() => _folder.Write("cube.obj", SampleFiles.Cube);

    public void Dispose() => _folder.Dispose();

    [Fact]
    public void FractalNumber_OfAnArgument_TellsWhereItsCallStands()
    {
        const string Text = "v 1 0 0\nv 0.5 0.5 0.5\nt.a. (a, #, 2)\nu.a.b. (a, #, b)\nx. \"a.obj\"\n"
            + "z<x>. [#, t.1, u.1.2] [t.1] x\n<$>. z 3\n";
        var calls = FractalNumber.FindAll(new("a.fdo", Text)).Where(static number => number.Call is not null)
            .Select(static number => (number.Call!.Value, number.Component, number.Value)).ToArray();
        Assert.Equal([((0, 1, 3), 0, 1.0), ((0, 2, 3), 0, 1.0), ((0, 2, 3), 1, 2.0), ((1, 0, 1), 0, 1.0)], calls);
        Assert.All(
            FractalNumber.FindAll(new("a.fdo", Text)),
            static number => Assert.Equal(number.Role == FractalNumberRole.Argument, number.Call is not null));
    }

    [Fact]
    public void FractalNumber_OfAnArgument_HasTheRoleOfItsParameterAlone()
    {
        const string Text = "v 2 -3 4\nv 1 0 0\nt.a. (a, #, 1)\nx. \"a.obj\"\nz<x>. [t.2] x\n<$>. z 3\n";
        var roles = FractalNumber.FindAll(new("a.fdo", Text)).Where(static number => number is { Component: 0, Name: ['v', ..] })
            .Select(static number => number.Role);
        Assert.Equal([FractalNumberRole.Scale, FractalNumberRole.Position], roles);
    }

    [Fact]
    public void FindAll_OfAFractal_ListsEachNumberAtItsPlace()
    {
        var text = Fractal.Replace("y<z>. [u.1] z\n", "", StringComparison.Ordinal);
        var numbers = FractalNumber.FindAll(new("row.fdo", text));
        Assert.Equal(16, numbers.Length);
        Assert.Equal(
            [("t 1", 0, 1.0), ("t 1", 1, 2.0), ("t 1", 2, 3.0)],
            numbers.Where(static number => number.Role == FractalNumberRole.Argument)
                .Select(static number => (number.Name, number.Component, number.Value)));
        Assert.All(numbers, number => Assert.Equal(
            number.Value, double.Parse(text.AsSpan(number.Offset, number.Length), System.Globalization.CultureInfo.InvariantCulture)));
        Assert.Equal(
            [FractalNumberRole.Position, FractalNumberRole.Rotation, FractalNumberRole.Scale, FractalNumberRole.Vector],
            numbers.Where(number => number.Component == 0 && number.Name[0] == 'v').Select(number => number.Role));
        Assert.Equal((FractalNumberRole.Depth, "z", 12.0), (numbers[^1].Role, numbers[^1].Name, numbers[^1].Value));
    }

    [Fact]
    public void Replace_OfANumber_KeepsAllOtherCharacters()
    {
        var text = Fractal.Replace("y<z>. [u.1] z\n", "", StringComparison.Ordinal);
        foreach (var number in FractalNumber.FindAll(new("row.fdo", text)))
        {
            // There are four vectors, and a call takes the number of one.
            var value = number.Role == FractalNumberRole.Argument ? 4 : 7;
            var changed = number.Replace(text, value);
            Assert.Equal(text[..number.Offset], changed[..number.Offset]);
            Assert.Equal(text[(number.Offset + number.Length)..], changed[(number.Offset + 1)..]);
            Assert.Equal(value, FractalNumber.FindAll(new("row.fdo", changed)).Single(other => other.Offset == number.Offset).Value);
        }
    }

    [Fact]
    public void FindAll_OfSampleFractals_ReadsAllOfThem() => Assert.All(
        Directory.GetFiles(Repository.Full("assets/fractals"), "*.fdo"),
        path => Assert.NotEmpty(FractalNumber.FindAll(new(path, File.ReadAllText(path)))));

    [Fact]
    public void Load_WithEditedTexts_ShowsThemAndKeepsOtherModels()
    {
        _folder.Write("row.fdo", "v 1 0 0\nt.a. (a, #, #)\nx. \"cube.obj\"\nz<x>. [#, t.1] x\n<$>. z 3\n");
        _folder.Write("scene.sdo", "o \"row.fdo\" #\no \"cube.obj\" #\n");
        var cache = new AssetCache();
        var first = AssetLoader.Load(_folder["scene.sdo"], cache: cache).Scene;
        var edits = FileEdits.None.With(_folder["row.fdo"], File.ReadAllText(_folder["row.fdo"]).Replace("z 3", "z 5"));
        var options = new LoadOptions { EditedTexts = edits.Texts };
        var second = AssetLoader.Load(_folder["scene.sdo"], options, cache: cache).Scene;
        Assert.Equal(32, (int)second.Objects[0].Model.InstanceCount!.Value);
        Assert.Same(first.Objects[1].Model, second.Objects[1].Model);
        Assert.Same(
            second.Objects[0].Model, AssetLoader.Load(_folder["scene.sdo"], options, cache: cache).Scene.Objects[0].Model);
        // Without the edit the file counts again.
        Assert.Equal(8, (int)AssetLoader.Load(_folder["scene.sdo"], new(), cache: cache).Scene.Objects[0].Model.InstanceCount!.Value);
    }

    [Fact]
    public void Rebase_OfAnEdit_KeepsWhatAnEditorHasChangedElsewhere()
    {
        var edited = new EditedFile("a\nb\nc\n", "a\nB\nc\n");
        Assert.Equal("new\na\nB\nc\n", edited.Rebase("new\na\nb\nc\n")?.Text);
        Assert.Equal("A\nB\nc\n", edited.Rebase("A\nb\nc\n")?.Text);
        Assert.Null(edited.Rebase("a\nother\nc\n"));
        Assert.Null(edited.Rebase("b\na\nc\nb\n"));
        Assert.Null(new EditedFile("a\n", "a\nmore\n").Rebase("b\n"));
        // A line that the edit itself has made is none of the file's.
        Assert.Equal("X\nB\nC", new EditedFile("A\nB", "B\nC").Rebase("X\nA\nB")?.Text);
    }

    [Theory]
    [InlineData("# note\nv\nv\nx", "# note\nv\nV\nx")]
    [InlineData("# note\nv\nv", "# note\nv\nV")]
    [InlineData("v\n# note\nv\nx", "v\n# note\nV\nx")]
    [InlineData("v\nv\nx\nv", "v\nV\nx\nv")]
    [InlineData("w\nv\nx", "w\nV\nx")]
    [InlineData("# note\nv\nv\nx\nv", null)]
    [InlineData("v\nx", null)]
    public void Rebase_OfTheSecondOfTwoLinesAlike_ChangesNoOther(string present, string? expected) =>
        Assert.Equal(expected, new EditedFile("v\nv\nx", "v\nV\nx").Rebase(present)?.Text);

    [Fact]
    public void FileEdits_OfTheTextOnTheDisk_AreNone()
    {
        _folder.Write("a.fdo", "one\n");
        var path = _folder["a.fdo"];
        var edits = FileEdits.None.With(path, "two\n");
        Assert.Equal("two\n", edits.TextOf(path));
        Assert.Equal("two\n", edits.Texts[path]);
        Assert.True(edits.With(path, "one\n").IsEmpty);
        // After a save, the text before it is the edit.
        Assert.True(edits.AfterSave(path, "one\n", "two\n").IsEmpty);
        Assert.Equal("one\n", FileEdits.None.AfterSave(path, "one\n", "two\n").TextOf(path));
    }

    [Fact]
    public void FileEdits_AfterASaveOfMore_AreNoneAndCarryTheRest()
    {
        _folder.Write("a.sdo", "view 1\none\n");
        var path = _folder["a.sdo"];
        static string Carry(string text) => text.Replace("view 1", "view 2", StringComparison.Ordinal);
        var edits = FileEdits.None.With(path, "view 1\ntwo\n");
        Assert.True(edits.AfterSave(path, "view 1\none\n", "view 2\ntwo\n", Carry).IsEmpty);
        // The text before the edit has what was saved beside it.
        Assert.Equal("view 2\none\n", FileEdits.None.AfterSave(path, "view 1\none\n", "view 2\ntwo\n", Carry).TextOf(path));
    }

    [Fact]
    public void SceneEditor_NamesWithAQuote_AreRefused()
    {
        const string Text = "o \"cube.obj\" #\n";
        foreach (var name in (string[])["a\"b", "a\nb", "a\rb"])
        {
            var error = Assert.Throws<ArgumentException>(() => SceneEditor.Change(Text, scene => scene with
            {
                Objects = [scene.Objects[0] with { Name = name }],
            }));
            Assert.Equal($"a name in a scene can't have a quote or a line break: {name}", error.Message);
            Assert.Throws<ArgumentException>(() => SceneEditor.Change(Text, scene => scene with
            {
                Objects = scene.Objects.Add(new(name, FractalEngine.Core.Maths.Transformation.Identity)),
            }));
        }
    }

    [Fact]
    public void FileEdits_ChangedElsewhereInTheSameLine_AreDroppedWithAMessage()
    {
        _folder.Write("a.fdo", "one\nx\n");
        var path = _folder["a.fdo"];
        var edits = FileEdits.None.With(path, "two\nx\n");
        var messages = new List<string>();
        Assert.Same(edits, edits.Rebase(messages.Add));
        _folder.Write("a.fdo", "one\ny\n");
        Assert.Equal("two\ny\n", edits.Rebase(messages.Add).TextOf(path));
        Assert.Empty(messages);
        _folder.Write("a.fdo", "three\nx\n");
        Assert.True(edits.Rebase(messages.Add).IsEmpty);
        Assert.Contains("a.fdo was changed elsewhere", Assert.Single(messages), StringComparison.Ordinal);
    }

    [Theory]
    [InlineData(false)]
    [InlineData(true)]
    public void Write_OfAnEdit_ReplacesTheTextAndKeepsTheMark(bool hasMark)
    {
        var path = _folder["a.fdo"];
        File.WriteAllText(path, "ä one\n", new System.Text.UTF8Encoding(hasMark));
        EditedFileWriter.Write(path, new("ä one\n", "ä two\n"));
        Assert.Equal("ä two\n", File.ReadAllText(path));
        Assert.Equal(hasMark, File.ReadAllBytes(path)[0] == 0xEF);
        Assert.Throws<IOException>(() => EditedFileWriter.Write(path, new("ä one\n", "ä three\n")));
        File.WriteAllBytes(path, [0xE4, (byte)'\n']);
        Assert.Throws<IOException>(() => EditedFileWriter.Write(path, new("ä one\n", "ä three\n")));
        Assert.Equal([0xE4, (byte)'\n'], File.ReadAllBytes(path));
    }

    [SkippableFact]
    public void Write_OntoWhatIsNoFileAnyMore_IsRefusedAtOnce()
    {
        Elsewhere.SkipOnWindows("there are no named pipes in folders");
        var pipe = _folder["pipe.sdo"];
        System.Diagnostics.Process.Start("mkfifo", pipe).WaitForExit();
        File.CreateSymbolicLink(_folder["zero.sdo"], "/dev/zero");
        Directory.CreateDirectory(_folder["folder.sdo"]);
        File.WriteAllBytes(_folder["large.sdo"], new byte[ParsingLimits.DescriptionBytes.Value + 1]);
        var reasons = new Dictionary<string, string>
        {
            ["pipe.sdo"] = "this is a pipe or a device", ["zero.sdo"] = "this is a pipe or a device",
            ["folder.sdo"] = "this is a directory", ["large.sdo"] = "more than the limit",
        };
        foreach (var (name, reason) in reasons)
        {
            Action[] writes =
            [
                () => EditedFileWriter.Write(_folder[name], new("a\n", "b\n")),
                () => SceneFileMerge.Write(_folder[name], "c (0, 0, 0) # 60\n", "c (1, 0, 0) # 60\n"),
            ];
            Assert.All(writes, write => Assert.Contains(reason, Assert.Throws<IOException>(write).Message, StringComparison.Ordinal));
        }
    }

    [Fact]
    public void SceneEditor_ChangesOnlyTheLineConcerned()
    {
        const string Text = "# a\no \"cube.obj\" ((1, 0, 0), #, #)  # not a comment\n# b\nlight ambient (1, 1, 1) 0.2\no \"cube.obj\" #\n";
        var text = Text.Replace("  # not a comment", "", StringComparison.Ordinal);
        var colour = SceneEditor.Change(text, scene => scene with
        {
            Objects = scene.Objects.SetItem(1, scene.Objects[1] with { Colour = Colour.Black }),
        });
        Assert.Equal(text.Replace("o \"cube.obj\" #\n", "o \"cube.obj\" # colour (0, 0, 0)\n", StringComparison.Ordinal), colour);
        Assert.Equal("# a\n# b\nlight ambient (1, 1, 1) 0.2\no \"cube.obj\" #\n", SceneEditor.RemoveObject(text, 0));
        Assert.Equal(text.Replace("light ambient (1, 1, 1) 0.2\n", "", StringComparison.Ordinal), SceneEditor.RemoveLight(text, 0));
    }

    [Fact]
    public void SceneEditor_HiddenObject_IsShownAgainInItsPlace()
    {
        const string Text = "o \"cube.obj\" #\r\n# note\r\no \"cube.obj\" # name \"b\"\r\n";
        var hidden = SceneEditor.HideObject(Text, 1);
        Assert.Equal("o \"cube.obj\" #\r\n# note\r\n#hidden o \"cube.obj\" # name \"b\"\r\n", hidden);
        var line = Assert.Single(SceneEditor.FindHidden(hidden));
        Assert.Equal("o \"cube.obj\" # name \"b\"", line);
        Assert.Equal(Text, SceneEditor.ShowObject(hidden, line));
        Assert.Empty(SceneEditor.FindHidden(Text));
    }

    [Fact]
    public void SceneEditor_HiddenObjectWhoseLineBeginsOthers_IsTheOneShown()
    {
        const string Others = "#hidden o \"a.obj\" # name \"x\"\r\n# #hidden o \"a.obj\" #\r\n";
        const string Text = Others + "#hidden o \"a.obj\" #\r\n#hidden o \"a.obj\" #";
        Assert.Equal(Others + "o \"a.obj\" #\r\n#hidden o \"a.obj\" #", SceneEditor.ShowObject(Text, SceneEditor.FindHidden(Text)[1]));
        Assert.Equal(Text, SceneEditor.ShowObject(Text, "o \"b.obj\" #"));
    }

    [Fact]
    public void History_Transformed_KeepsItsSteps()
    {
        var history = new UndoHistory<int>(0).Record(1).Record(2).Record(3).Undo()!.Undo()!.Transform(static state => 10 * state);
        Assert.Equal(10, history.Present);
        history = history.Redo()!;
        Assert.Equal(20, history.Present);
        history = history.Redo()!;
        Assert.Equal(30, history.Present);
        Assert.Null(history.Redo());
        history = (history with { Present = 31 }).Undo()!.Undo()!.Undo()!;
        Assert.Equal(0, history.Present);
    }
}
