using System.Globalization;
using System.Text.RegularExpressions;
using FractalEngine.Parsing.Text;

namespace FractalEngine.Tests.Recorded;

/// <summary>
/// Puts every small fault into texts that are right: each word is left out, doubled, or replaced by something else, and the text ends
/// behind it. Each message that follows is noted once, with how often it comes and the sum of its places; so is what is still right.
/// </summary>
internal sealed partial class FaultSweep
{
    private static readonly string[] Replacements = ["x", "-1", "0", "2.5", "1e999", "\"", "(", ")", ",", "#", "nan"];

    private readonly SortedDictionary<string, (int Count, long Places, int Words)> _messages = new(StringComparer.Ordinal);
    private readonly List<string> _texts = [];

    /// <summary>Parses a text and all that becomes of it by one fault.</summary>
    /// <param name="text">A text that is right.</param>
    /// <param name="parse">Parses it, to a value and warnings.</param>
    public void Run(string text, Func<string, (object Value, IEnumerable<Diagnostic> Warnings)> parse)
    {
        int count = 0;
        int hash = 0;
        var numbers = new List<double>();
        foreach (string variant in Variants(text))
        {
            try
            {
                var (value, warnings) = parse(variant);
                Note(warnings);
                string described = Description.Of(value);
                numbers.AddRange(Numbers().Matches(described).Select(match => double.Parse(match.Value, CultureInfo.InvariantCulture))
                    .Where(number => Math.Abs(number) < 1e12));
                hash = Numbers().Replace(described, "").Aggregate(hash, (sum, letter) => unchecked((sum * 31) + letter));
                count++;
            }
            catch (SourceException exception)
            {
                Note([exception.Diagnostic]);
            }
        }

        string shown = text.Replace("\n", "⏎", StringComparison.Ordinal).Replace("\r", "␍", StringComparison.Ordinal);
        _texts.Add(string.Create(
            CultureInfo.InvariantCulture,
            $"{count} right, {Description.OfNumbers(numbers)}, words {hash:x8}: {shown[..Math.Min(shown.Length, 160)]}"));
    }

    /// <summary>All that was noted, a line each.</summary>
    public IEnumerable<string> Lines() =>
    [
        .. _texts,
        .. _messages.Select(message => string.Create(
            CultureInfo.InvariantCulture,
                $"{message.Value.Count} at {message.Value.Places}, words {message.Value.Words:x8}: {message.Key}")),
    ];

    private void Note(IEnumerable<Diagnostic> diagnostics)
    {
        foreach (var diagnostic in diagnostics)
        {
            string key = (diagnostic.Severity == DiagnosticSeverity.Warning ? "warning: " : "")
                + (diagnostic.IsLimitExceeded ? "limit: " : "") + diagnostic.Message;
            int words = key.Aggregate(17, (sum, letter) => unchecked((sum * 31) + letter));
            key = Faulty().Replace(key, "$1 …");
            var (count, places, known) = _messages.GetValueOrDefault(key);
            places += (1000 * diagnostic.Line) + diagnostic.Column + (diagnostic.SourceLine?.Length ?? 0);
            _messages[key] = (count + 1, places, unchecked(known + words));
        }
    }

    private static IEnumerable<string> Variants(string text)
    {
        yield return text;
        foreach (Match word in Words().Matches(text))
        {
            string before = text[..word.Index];
            string after = text[(word.Index + word.Length)..];
            yield return before;
            yield return before + after;
            yield return before + word.Value + " " + word.Value + after;
            foreach (string replacement in Replacements)
            {
                yield return before + replacement + after;
            }
        }
    }

    [GeneratedRegex("""
        "[^"\n]*"|[\p{L}_][\w-]*|-?[0-9]+(?:\.[0-9]+)?(?:e-?[0-9]+)?|[^\s]
        """)]
    private static partial Regex Words();

    // What was found, of which there is more than of what is expected.
    [GeneratedRegex(
        @"^((?:warning: )?(?:limit: )?(?:unexpected|the number|the scale|the depth|vector|the object|the transformation"
        + @"|the parameter|did))\b(?:[^,:(]|'[,:(]')*")]
    private static partial Regex Faulty();

    [GeneratedRegex(@"-?\d+(?:\.\d+)?(?:E[+-]\d+)?")]
    private static partial Regex Numbers();
}
