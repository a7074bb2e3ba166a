using System.Globalization;

namespace FractalEngine.Benchmarks.Measuring;

/// <summary>Parses what stands after a command: options, and names of what the command measures.</summary>
/// <param name="usage">Usage of the command, written where an argument is not expected.</param>
internal sealed class CommandLineParser(string usage)
{
    private readonly Dictionary<string, Action> _flags = [];
    private readonly Dictionary<string, Func<string, bool>> _options = [];
    private Func<string, bool> _tryAddName = static _ => false;

    /// <summary>Folder in which the repository keeps its measurements.</summary>
    public static string DefaultFolder => Path.Combine(Path.GetDirectoryName(FractalCase.Assets)!, "docs", "benchmarks");

    /// <summary>Folder of measurements unless stated: those of small shapes are kept apart, where git ignores them.</summary>
    public static string FolderFor(bool isQuick) =>
        isQuick ? Path.Combine(Path.GetDirectoryName(FractalCase.Assets)!, "out", "benchmarks") : DefaultFolder;

    /// <summary>Declares an option without a value.</summary>
    public CommandLineParser Flag(string option, Action set)
    {
        _flags.Add(option, set);
        return this;
    }

    /// <summary>Declares an option whose value may be anything but another option.</summary>
    public CommandLineParser Option(string option, Action<string> set) => Option(option, text =>
    {
        var isValue = !text.StartsWith('-');
        if (isValue)
        {
            set(text);
        }

        return isValue;
    });

    /// <summary>Declares an option with a value.</summary>
    /// <param name="option">Name of the option with its dashes.</param>
    /// <param name="trySet">Sets the value, or returns false where the text is none.</param>
    public CommandLineParser Option(string option, Func<string, bool> trySet)
    {
        _options.Add(option, trySet);
        return this;
    }

    /// <summary>Declares an option with a positive whole number.</summary>
    public CommandLineParser Count(string option, Action<int> set) => Option(option, text =>
    {
        var isCount = TryParseCount(text, out var count);
        if (isCount)
        {
            set(count);
        }

        return isCount;
    });

    /// <summary>Declares which words are names, and collects these in a list.</summary>
    public CommandLineParser Names(Func<string, bool> isName, List<string> names)
    {
        _tryAddName = text =>
        {
            var isKnown = isName(text);
            if (isKnown)
            {
                names.Add(text);
            }

            return isKnown;
        };
        return this;
    }

    /// <summary>
    /// Parses the arguments. At the first that is not expected it writes an error and the usage to standard error, and returns false.
    /// </summary>
    public bool TryParse(ReadOnlySpan<string> args)
    {
        for (var i = 0; i < args.Length; i++)
        {
            if (_flags.TryGetValue(args[i], out var setFlag))
            {
                setFlag();
            }
            else if (i + 1 < args.Length && _options.TryGetValue(args[i], out var trySet) && trySet(args[i + 1]))
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

    /// <summary>Parses a positive whole number of digits only.</summary>
    public static bool TryParseCount(string text, out int count) =>
        int.TryParse(text, NumberStyles.None, CultureInfo.InvariantCulture, out count) && count > 0;
}
