using System.Collections.Immutable;
using System.Text;
using FractalEngine.App.Commands;
using FractalEngine.App.Window.Actions;
using FractalEngine.App.Window.Input;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes.Cameras;
using FractalEngine.Render.Cameras;
using FractalEngine.Render.Windowing.Events;
using FractalEngine.Render.Windowing.Keyboard;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.App.Window.Actions;

/// <summary>Tests that keys, menus, options and the manual follow the table of actions.</summary>
public class ActionTableTests
{
    private const string TableHead = "| key | menu | effect | option |\n|---|---|---|---|\n";

    /// <summary>
    /// The table of the manual is written from the actions:
    /// <c>REWRITE_DOCS=1 dotnet test FractalEngine.Tests --filter ActionTableTests</c>.
    /// </summary>
    [Fact]
    public void Manual_ListsEveryAction()
    {
        var path = Repository.Full("docs/manual.md");
        var manual = File.ReadAllText(path);
        var start = manual.IndexOf(TableHead, StringComparison.Ordinal);
        Assert.True(start >= 0, "the manual has no table of actions");
        var end = manual.IndexOf("\n\n", start, StringComparison.Ordinal) + 1;
        var table = ManualTable();
        if (Environment.GetEnvironmentVariable("REWRITE_DOCS") is "1")
        {
            File.WriteAllText(path, manual[..start] + table + manual[end..]);
            return;
        }

        Assert.Equal(table, manual[start..end]);
    }

    [Fact]
    public void Ids_Menus_Names_AreUniqueAndWellFormed()
    {
        Assert.Equal(ActionTable.All.Length, ActionTable.All.Select(static action => action.Id).Distinct().Count());
        Assert.All(ActionTable.All, static action =>
        {
            Assert.Matches("^[a-z]+(-[a-z]+)*$", action.Id);
            Assert.Contains(action.Menu, ActionTable.Menus);
            Assert.True(action.Help.Length > 2 && !action.Help.EndsWith('.'), action.Id);
            Assert.Equal(action.IsCommand, action.Name.Length > 0);
        });
        var commands = ActionTable.All.Where(static action => action.IsCommand).ToArray();
        Assert.Equal(commands.Length, commands.Select(static action => (action.Menu, action.Name)).Distinct().Count());
    }

    [Fact]
    public void Flags_AreOptionsOfTheCommandView()
    {
        var options = ViewCommand.Create().Options.Select(static option => option.Name).ToHashSet();
        Assert.All(ActionTable.All.Where(static action => action.Flag is not null), action => Assert.Contains(action.Flag!, options));
    }

    [Fact]
    public void Keys_OfEveryAction_FindIt()
    {
        Assert.All(
            from action in ActionTable.All
            from chord in action.Keys
            select (action, chord),
            static pair => Assert.Same(pair.action, ActionTable.Find(new(pair.chord.Key, pair.chord.Modifiers, IsRepeat: false))));
        Assert.Equal("reset-camera", ActionTable.Find(new(Key.KeypadEnter, KeyModifiers.None, false))?.Id);
        Assert.Equal("view-top", ActionTable.Find(new(Key.Keypad7, KeyModifiers.Shift, false))?.Id);
        Assert.Equal("open", ActionTable.Find(new(Key.O, KeyModifiers.Control | KeyModifiers.Shift, false))?.Id);
        Assert.Null(ActionTable.Find(new(Key.F, KeyModifiers.Control, false)));
        // + needs Shift on many keyboards.
        Assert.Equal("larger-text", ActionTable.Find(new(Key.Plus, KeyModifiers.Control | KeyModifiers.Shift, false))?.Id);
    }

    [Fact]
    public void Keys_OfTheCamera_MoveIt()
    {
        var moving = ActionTable.All.Where(static action => action is { MoveCamera: not null, Id: not "reset-camera" }
            || action.Id.StartsWith("fly-", StringComparison.Ordinal));
        Assert.All(moving, static action => Assert.All(action.Keys, chord =>
        {
            var bounds = new BoundingBox(-Vector.One, Vector.One);
            var camera = new FlyingCamera(bounds, new(new(2, 3, -9), new(0.3, 0.2, 0), 60), Projection.Perspective, null);
            var controls = new CameraControls(camera);
            var pressed = new KeyPressed(chord.Key, chord.Modifiers, IsRepeat: false);
            Assert.True(controls.Handle(pressed, 1.5, ActionTable.Find(pressed)?.MoveCamera), $"{action.Id}: {chord}");
        }));
    }

    [Fact]
    public void Chords_AreReadAsTheyAreWritten()
    {
        Assert.All(ActionTable.All.SelectMany(static action => action.Keys), static chord =>
        {
            Assert.True(KeyChord.TryParse(chord.ToString().ToUpperInvariant(), out var read), chord.ToString());
            Assert.Equal(chord, read);
        });
        Assert.False(KeyChord.TryParse("Ctrl+", out _));
        Assert.False(KeyChord.TryParse("Hyper+Q", out _));
    }

    [Fact]
    public void Bindings_OfChangedKeys_TranslatePressAndRelease()
    {
        Assert.True(KeyChord.TryParse("Ctrl+G", out var grid));
        var bindings = new KeyBindings(new Dictionary<string, KeyChord>
        {
            ["grid"] = grid,
            ["fly-forward"] = new(Key.Z),
        }.ToImmutableDictionary());
        var gridKey = bindings.Translate(new KeyPressed(Key.G, KeyModifiers.Control, false));
        Assert.Equal(new KeyPressed(Key.G, KeyModifiers.None, false), gridKey);
        Assert.Equal(Key.Unknown, ((KeyPressed)bindings.Translate(new KeyPressed(Key.G, KeyModifiers.None, false))).Key);
        Assert.Equal(Key.W, ((KeyPressed)bindings.Translate(new KeyPressed(Key.Z, KeyModifiers.Shift, false))).Key);
        Assert.Equal(Key.W, ((KeyReleased)bindings.Translate(new KeyReleased(Key.Z, KeyModifiers.None))).Key);
        Assert.Equal(Key.Unknown, ((KeyPressed)bindings.Translate(new KeyPressed(Key.W, KeyModifiers.None, false))).Key);
        // The second key of the action stays.
        Assert.Equal(Key.Up, ((KeyPressed)bindings.Translate(new KeyPressed(Key.Up, KeyModifiers.None, false))).Key);
        Assert.Equal("Z, Up", bindings.TextOf(ActionTable.All.Single(static action => action.Id == "fly-forward")));
    }

    private static string ManualTable()
    {
        var table = new StringBuilder(TableHead);
        foreach (var action in ActionTable.All)
        {
            var flag = action.Flag is null ? "" : $"`{action.Flag}`";
            var menu = action.IsCommand ? $"{action.Menu} > {action.Name}" : "";
            table.Append(string.Join(" | ", $"| {action.KeyText}", menu, action.Help, $"{flag} |\n").Replace("|  |", "| |"));
        }

        return table.ToString();
    }
}
