using System.Globalization;
using System.Text;
using Microsoft.CodeAnalysis.Text;

namespace FractalEngine.Mutants;

/// <summary>Where a mutant stands in an instrumented file.</summary>
/// <param name="Mutation">The mutant.</param>
/// <param name="Whole">All that was written for it, with the original and the mutants within.</param>
/// <param name="Changed">The changed text; of a body all of it.</param>
internal sealed record Placed(Mutation Mutation, TextSpan Whole, TextSpan Changed);

/// <summary>Writes a file in which each mutant stands beside its original, and a number chooses.</summary>
internal sealed class Instrumenter
{
    private readonly string _source;
    private readonly StringBuilder _output = new();
    private readonly List<Placed> _placed = [];

    private Instrumenter(string source) => _source = source;

    /// <summary>Returns the instrumented text, and where each mutant stands in it.</summary>
    /// <param name="source">Text of the file.</param>
    /// <param name="mutations">All mutants of the file.</param>
    public static (string Text, IReadOnlyList<Placed> Placed) Write(string source, IEnumerable<Mutation> mutations)
    {
        var instrumenter = new Instrumenter(source);
        instrumenter.WriteRange(new(0, source.Length), [.. mutations
            .OrderBy(mutation => SpanOf(mutation).Start).ThenByDescending(mutation => SpanOf(mutation).Length)
            .ThenByDescending(mutation => mutation.Form)]);
        return (instrumenter._output.ToString(), instrumenter._placed);
    }

    private static TextSpan SpanOf(Mutation mutation) => mutation.Form == Form.Body ? mutation.Site.Body!.Span : mutation.Site.Span;

    private static string Condition(Mutation mutation) =>
        string.Create(CultureInfo.InvariantCulture, $"global::FractalEngineMutants.Mutant.Is({mutation.Number})");

    private void WriteRange(TextSpan range, List<Mutation> mutations)
    {
        int position = range.Start;
        while (mutations.Count > 0)
        {
            var outer = mutations[0];
            var span = SpanOf(outer);
            var same = outer.Form == Form.Body
                ? mutations.FindAll(mutation => mutation.Form == Form.Body && SpanOf(mutation) == span)
                : [outer];
            var inner = mutations.FindAll(mutation => span.Contains(SpanOf(mutation)) && !same.Contains(mutation));
            mutations = mutations.FindAll(mutation => !span.Contains(SpanOf(mutation)));
            _output.Append(_source, position, span.Start - position);
            position = span.End;
            if (outer.Form == Form.Body)
            {
                WriteBodies(same, inner);
            }
            else
            {
                WriteBoth(outer, inner);
            }
        }

        _output.Append(_source, position, range.End - position);
    }

    private void WriteBoth(Mutation mutation, List<Mutation> inner)
    {
        int start = _output.Length;
        string text = mutation.Change.Text;
        TextSpan changed;
        if (mutation.Form == Form.Statement)
        {
            _output.Append("{ if (").Append(Condition(mutation)).Append(") { ");
            changed = WriteChanged(text);
            _output.Append(" } else { ");
            WriteRange(mutation.Site.Span, inner);
            _output.Append(" } }");
        }
        else
        {
            // These take their types from the place where they stand, and must not be in brackets.
            bool isBare = text is "default" or "[]";
            bool isCollection = _source[mutation.Site.Span.Start] == '[';
            _output.Append('(').Append(Condition(mutation)).Append(isBare ? " ? " : " ? (");
            changed = WriteChanged(text);
            _output.Append(isBare ? " : " : ") : ").Append(isCollection ? "" : "(");
            WriteRange(mutation.Site.Span, inner);
            _output.Append(isCollection ? ")" : "))");
        }

        _placed.Add(new(mutation, TextSpan.FromBounds(start, _output.Length), changed));
    }

    private void WriteBodies(List<Mutation> mutations, List<Mutation> inner)
    {
        int start = _output.Length;
        var body = mutations[0].Site.Body!;
        var kept = body.Expression ?? body.Span;
        string before = body.Expression is null ? "" : body.IsVoid ? "{ " : "{ return ";
        string after = body.Expression is null ? "" : "; }";
        var changed = new List<TextSpan>();
        _output.Append(body.IsProperty ? "{ get { " : "{ ");
        foreach (var mutation in mutations)
        {
            var site = mutation.Site.Span;
            _output.Append("if (").Append(Condition(mutation)).Append(") ");
            int copy = _output.Length;
            _output.Append(before).Append(_source, kept.Start, site.Start - kept.Start).Append(mutation.Change.Text)
                .Append(_source, site.End, kept.End - site.End).Append(after);
            changed.Add(TextSpan.FromBounds(copy, _output.Length));
            _output.Append(" else ");
        }

        _output.Append(before);
        WriteRange(kept, inner);
        _output.Append(after).Append(body.IsProperty ? " } }" : " }");
        var whole = TextSpan.FromBounds(start, _output.Length);
        for (int i = 0; i < mutations.Count; i++)
        {
            _placed.Add(new(mutations[i], whole, changed[i]));
        }
    }

    private TextSpan WriteChanged(string text)
    {
        int start = _output.Length;
        _output.Append(text);
        return TextSpan.FromBounds(start, _output.Length);
    }
}
