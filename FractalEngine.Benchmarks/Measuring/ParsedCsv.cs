using System.Globalization;
using System.Text;

namespace FractalEngine.Benchmarks.Measuring;

/// <summary>A table parsed by the rules of RFC 4180, below its comments.</summary>
/// <param name="Comments">Lines at the start that begin with <c>#</c>.</param>
/// <param name="Header">Names of the columns.</param>
/// <param name="Rows">Fields of the rows, without the quotes around them.</param>
internal sealed record ParsedCsv(string[] Comments, string[] Header, string[][] Rows)
{
    /// <exception cref="FormatException">A quote is misplaced or not closed, or the last line has no end.</exception>
    public static ParsedCsv Parse(string text)
    {
        var start = 0;
        var comments = new List<string>();
        while (start < text.Length && text[start] == '#')
        {
            var end = text.IndexOf('\n', start);
            comments.Add(text[start..end]);
            start = end + 1;
        }

        var records = Records(text[start..]);
        return new([.. comments], records[0], [.. records.Skip(1)]);
    }

    public static ParsedCsv Read(string file) => Parse(File.ReadAllText(file));

    /// <summary>Returns the fields of a column.</summary>
    public string[] Column(string name) => [.. Rows.Select(row => row[IndexOf(name)])];

    /// <summary>Returns the rows as functions from a column's name to the field.</summary>
    public IEnumerable<Func<string, string>> NamedRows() => Rows.Select<string[], Func<string, string>>(row => name => row[IndexOf(name)]);

    public static double ParseNumber(string field) => double.Parse(field, NumberStyles.Float, CultureInfo.InvariantCulture);

    private int IndexOf(string name)
    {
        var index = Array.IndexOf(Header, name);
        return index >= 0 ? index : throw new KeyNotFoundException($"no column '{name}'");
    }

    private static List<string[]> Records(string text)
    {
        var records = new List<string[]>();
        var fields = new List<string>();
        var field = new StringBuilder();
        var isQuoted = false;
        for (var i = 0; i < text.Length; i++)
        {
            if (isQuoted)
            {
                if (text[i] != '"')
                {
                    field.Append(text[i]);
                }
                else if (i + 1 < text.Length && text[i + 1] == '"')
                {
                    field.Append(text[i++]);
                }
                else
                {
                    isQuoted = false;
                    ThrowUnless(i + 1 < text.Length && text[i + 1] is ',' or '\n', i);
                }
            }
            else if (text[i] == '"')
            {
                ThrowUnless(field.Length == 0, i);
                isQuoted = true;
            }
            else if (text[i] is ',' or '\n')
            {
                fields.Add(field.ToString());
                field.Clear();
                if (text[i] == '\n')
                {
                    records.Add([.. fields]);
                    fields.Clear();
                }
            }
            else
            {
                ThrowUnless(text[i] != '\r', i);
                field.Append(text[i]);
            }
        }

        ThrowUnless(!isQuoted && fields.Count == 0 && field.Length == 0, text.Length);
        return records;
    }

    private static void ThrowUnless(bool condition, int offset)
    {
        if (!condition)
        {
            throw new FormatException($"no table, from character {offset}");
        }
    }
}
