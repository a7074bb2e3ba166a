using System.Globalization;

namespace FractalEngine.Tests.App.Window.Interactions;

/// <content>Steps that the program learns of at once, and what editors do meanwhile.</content>
internal sealed partial class Scenario
{
    /// <summary>Presses keys, all before the program learns of the first, so that no load ends in between.</summary>
    public static Action<Scenario> AtOnce(string keys) => s => s.Window.WhileStopped(() => Keys(keys)(s));

    /// <summary>
    /// Opens files one behind the other, types the first number below a text, and presses keys, all before the first load can end.
    /// </summary>
    public static Action<Scenario> OpenAllAndTypeAtOnce(string[] files, string value, string text, string keys = "") => s =>
    {
        var (x, y) = s.Place(text, 0, 3, 1, isRight: false);
        s.Window.WhileStopped(() =>
        {
            foreach (var file in files)
            {
                s.Window.Send($"key ctrl+o {KeysOf(file)} key Return");
            }

            s.Window.Send(string.Create(
                CultureInfo.InvariantCulture, $"mousemove --window {{window}} {x} {y} click 1 key ctrl+a {KeysOf(value)} key Return"));
            if (keys.Length > 0)
            {
                Keys(keys)(s);
            }
        });
    };

    /// <summary>Types numbers into columns of the row below a text, all before the first of them can be loaded.</summary>
    public static Action<Scenario> TypeAtOnce(string text, params string[] values) => s =>
    {
        var places = values.Select((_, column) => s.Place(text, column, values.Length, 1, isRight: false)).ToArray();
        s.Window.WhileStopped(() =>
        {
            foreach (var (value, (x, y)) in values.Zip(places))
            {
                s.Window.Send(string.Create(
                    CultureInfo.InvariantCulture, $"mousemove --window {{window}} {x} {y} click 1 key ctrl+a {KeysOf(value)} key Return"));
            }
        });
        s.MoveAway();
    };

    /// <summary>Changes a text in a file as an editor does.</summary>
    public static Action<Scenario> Replace(string before, string after, string file = "scene.sdo") => s =>
    {
        var text = File.ReadAllText(s._folder[file]);
        Assert.Contains(before, text, StringComparison.Ordinal);
        s._folder.Write(file, text.Replace(before, after, StringComparison.Ordinal));
    };

    /// <summary>The program has written so many lines with a text to stderr.</summary>
    public static Action<Scenario> ReportsTimes(string text, int count) => s =>
        Support.Polling.WaitUntil(() => s.Window.CountErrors(text) >= count, $"{count} lines '{text}'");

    private static string KeysOf(string text) => string.Join(' ', text.Select(static character => character switch
    {
        '.' => "key period",
        '-' => "key minus",
        _ => $"key {character}",
    }));
}
