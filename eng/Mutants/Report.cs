using System.Globalization;
using System.Text;

namespace FractalEngine.Mutants;

/// <summary>Says what the tests noticed, and decides whether that is enough.</summary>
internal sealed class Report
{
    private const double MinNoticed = 0.92;
    private const double MinNoticedOfGroup = 0.85;
    private const double MinNoticedByHand = 0.9;
    private const double MaxEquivalent = 0.05;
    // Standard errors that one sample in a hundred exceeds.
    private const double Chance = 2.33;
    private readonly StringBuilder _text = new();

    private Report()
    {
    }

    /// <summary>The text of the report.</summary>
    public string Text => _text.ToString();

    /// <summary>Whether enough was noticed.</summary>
    public bool IsPassed { get; private set; } = true;

    /// <summary>Writes the report of a draw.</summary>
    /// <param name="title">What was drawn.</param>
    /// <param name="mutations">The mutants.</param>
    /// <param name="verdicts">What became of them, by their names.</param>
    /// <param name="equivalents">Mutants that are called equivalent, with the reasons.</param>
    /// <param name="sources">The files, for the lines.</param>
    /// <param name="allowChance">Whether a share passes that one draw in a hundred falls below although the true one is right.</param>
    public static Report Make(
        string title, IReadOnlyList<Mutation> mutations, IReadOnlyDictionary<string, Verdict> verdicts,
        IReadOnlyDictionary<string, string> equivalents, IReadOnlyDictionary<string, string> sources,
        bool allowChance)
    {
        double Bound(double share, int count) => allowChance ? share - Chance * Math.Sqrt(share * (1 - share) / count) : share;
        var report = new Report();
        report.Line(title);
        report.Line("");
        foreach (string outcome in (string[])["survived", "not reached"])
        {
            foreach (var mutation in mutations.Where(mutation => verdicts[mutation.Id].Outcome == outcome)
                .OrderBy(mutation => mutation.Site.Path, StringComparer.Ordinal).ThenBy(mutation => mutation.Site.Span.Start))
            {
                report.Describe(mutation, verdicts[mutation.Id], sources[mutation.Site.Path], equivalents.GetValueOrDefault(mutation.Id));
            }
        }

        report.Line($"{"group",-24}{"N",6}{"noticed",9}{"survived",10}{"not reached",13}{"equivalent",12}{"%",7}");
        var groups = mutations.GroupBy(mutation => mutation.Group).ToList();
        foreach (var group in groups)
        {
            double noticed = report.Count(group.Key, [.. group], verdicts, equivalents);
            double asked = group.Key == HandFaults.Group ? MinNoticedByHand : MinNoticedOfGroup;
            report.Demand(groups.Count == 1 || noticed >= Bound(asked, group.Count()), $"{group.Key}: under {asked:0%}");
        }

        // Faults by hand are no part of a draw.
        bool isByHand = groups.TrueForAll(group => group.Key == HandFaults.Group);
        mutations = [.. mutations.Where(one => isByHand || one.Group != HandFaults.Group)];
        if (groups.Count > 1)
        {
            report.Count("all drawn", mutations, verdicts, equivalents);
        }

        double askedOfAll = isByHand ? MinNoticedByHand : MinNoticed;
        bool isEnough = Share(mutations, verdicts, equivalents) >= Bound(askedOfAll, mutations.Count);
        report.Demand(isEnough, $"all: under {askedOfAll:0%}");

        int called = mutations.Count(mutation => IsEquivalent(mutation, verdicts, equivalents));
        report.Demand(called <= MaxEquivalent * mutations.Count, $"{called} are called equivalent, more than {MaxEquivalent:0%}");
        foreach (var mutation in mutations.Where(one => equivalents.ContainsKey(one.Id) && verdicts[one.Id].Outcome == "noticed"))
        {
            report.Line($"{mutation.Id} is called equivalent, but is noticed: {verdicts[mutation.Id].Note}");
        }

        return report;
    }

    private static bool IsEquivalent(
        Mutation mutation, IReadOnlyDictionary<string, Verdict> verdicts, IReadOnlyDictionary<string, string> equivalents) =>
        equivalents.ContainsKey(mutation.Id) && verdicts[mutation.Id].Outcome != "noticed";

    private static double Share(
        IReadOnlyList<Mutation> mutations, IReadOnlyDictionary<string, Verdict> verdicts, IReadOnlyDictionary<string, string> equivalents)
    {
        int noticed = mutations.Count(mutation => verdicts[mutation.Id].Outcome == "noticed");
        int counted = mutations.Count(mutation => !IsEquivalent(mutation, verdicts, equivalents));
        return counted == 0 ? 1 : (double)noticed / counted;
    }

    private double Count(
        string name, IReadOnlyList<Mutation> mutations, IReadOnlyDictionary<string, Verdict> verdicts,
        IReadOnlyDictionary<string, string> equivalents)
    {
        var counted = mutations.Where(mutation => !IsEquivalent(mutation, verdicts, equivalents))
            .Select(mutation => verdicts[mutation.Id].Outcome).ToList();
        double share = Share(mutations, verdicts, equivalents);
        int Of(string outcome) => counted.Count(one => one == outcome);
        int equivalent = mutations.Count - counted.Count;
        Line($"{name,-24}{mutations.Count,6}{Of("noticed"),9}{Of("survived"),10}{Of("not reached"),13}{equivalent,12}{100 * share,7:0.0}");
        return share;
    }

    private void Describe(Mutation mutation, Verdict verdict, string source, string? reason)
    {
        int start = mutation.Site.Span.Start;
        int line = source.AsSpan(0, start).Count('\n') + 1;
        int lineStart = source.LastIndexOf('\n', Math.Max(0, start - 1)) + 1;
        int lineEnd = source.IndexOf('\n', start);
        string tests = verdict.Tests == 1 ? "1 test reaches it" : $"{verdict.Tests} tests reach it";
        string note = verdict.Note.Length > 0 ? $", {verdict.Note}" : "";
        string state = reason is null ? verdict.Outcome : "equivalent";
        Line($"{mutation.Id} {mutation.Site.Path}:{line}:{start - lineStart + 1}: {state} ({mutation.Change.Operator}; {tests}{note})");
        Line("    " + source[lineStart..(lineEnd < 0 ? source.Length : lineEnd)].Trim());
        Line($"    - {OneLine(mutation.Site.Original)}");
        Line($"    + {OneLine(mutation.Change.Text)}");
        if (reason is not null)
        {
            Line($"    {reason}");
        }

        Line("");
    }

    private static string OneLine(string text)
    {
        string line = string.Join(' ', text.Split((char[]?)null, StringSplitOptions.RemoveEmptyEntries));
        return line.Length <= 200 ? line : line[..200] + " ...";
    }

    private void Demand(bool isMet, string message)
    {
        if (!isMet)
        {
            IsPassed = false;
            Line("failed: " + message);
        }
    }

    private void Line(FormattableString line) => Line(line.ToString(CultureInfo.InvariantCulture));

    private void Line(string line) => _text.Append(line).Append('\n');
}
