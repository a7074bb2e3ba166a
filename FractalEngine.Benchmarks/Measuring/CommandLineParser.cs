using System.Globalization;

namespace FractalEngine.Benchmarks.Measuring;

/// <summary>What may stand after a command: options, and names of what it measures.</summary>
/// <param name="usage">Written where something else stands there.</param>
internal sealed class CommandLineParser(string usage)
{
    private readonly Dictionary<string, Action> _flags = [];
    private readonly Dictionary<string, Func<string, bool>> _options = [];
    private Func<string, bool> _tryAddName = static _ => false;

    /// <summary>Where measurements are kept.</summary>
    public static string DefaultFolder => Path.Combine(Path.GetDirectoryName(FractalCase.Assets)!, "docs", "benchmarks");

    /// <summary>An option without a value.</summary>
    public CommandLineParser Flag(string option, Action set)
    {
        _flags.Add(option, set);
        return this;
    }

    /// <summary>An option with a value of any form but that of an option.</summary>
    public CommandLineParser Option(string option, Action<string> set) => Option(option, text =>
    {
        var isValue = !text.StartsWith('-');
        if (isValue)
        {
            set(text);
        }

        return isValue;
    });

    /// <summary>An option with a value.</summary>
    /// <param name="option">With its dashes.</param>
    /// <param name="trySet">False for a value that is none.</param>
    public CommandLineParser Option(string option, Func<string, bool> trySet)
    {
        _options.Add(option, trySet);
        return this;
    }

    /// <summary>An option with a positive whole number.</summary>
    public CommandLineParser Count(string option, Action<int> set) => Option(option, text =>
    {
        var isCount = TryParseCount(text, out var count);
        if (isCount)
        {
            set(count);
        }

        return isCount;
    });

    /// <summary>Words that are no options.</summary>
    public CommandLineParser Names(Func<string, bool> isName, List<string> names)
    {
        _tryAddName = text =>
        {
            var known = isName(text);
            if (known)
            {
                names.Add(text);
            }

            return known;
        };
        return this;
    }

    /// <summary>Reads them; false, with a line on standard error, where one is not expected.</summary>
    public bool TryParse(ReadOnlySpan<string> args)
    {
        for (var i = 0; i < args.Length; i++)
        {
            if (_flags.TryGetValue(args[i], out var flag))
            {
                flag();
            }
            else if (i + 1 < args.Length && _options.TryGetValue(args[i], out var value) && value(args[i + 1]))
            {
                i++;
            }
            else if (!_tryAddName(args[i]))
            {
                Console.Error.WriteLine($"error: unexpected '{args[i]}'\n{usage}");
                return false;
            }
        }

        return true;
    }

    /// <summary>A positive whole number.</summary>
    public static bool TryParseCount(string text, out int count) =>
        int.TryParse(text, NumberStyles.None, CultureInfo.InvariantCulture, out count) && count > 0;
}
