using System.Collections.Immutable;
using FractalEngine.Core;
using FractalEngine.Core.Fractals.Descriptions;

namespace FractalEngine.Parsing.Fdo.Writing;

/// <summary>Declares the parts of a fractal, each under a name.</summary>
/// <param name="writer">Receives the lines.</param>
/// <param name="names">The names of the base meshes; receives those of the parts.</param>
internal sealed class FractalPartWriter(FractalWriter writer, List<string> names)
{
    // The parser keeps longer sets on parts as parts of their own.
    private const int MaxSetLength = 8;

    // By their recursives: the names of those that others call with fewer levels, or that are parts themselves.
    private readonly List<(RecursivePart Part, Dictionary<int, string> Names)> _groups = [];
    private int _depth;
    private string? _seed;

    /// <summary>Writes the declarations of parts, in their order.</summary>
    public void Write(ImmutableArray<FractalPart> parts)
    {
        foreach (var part in parts)
        {
            var value = part switch
            {
                SteppedPart stepped => writer.WriteSteps(stepped.Steps, names[stepped.Inner]),
                RecursivePart { IsFlat: true, Recursives: [{ Choice: { } choice } one] } => FormatFlat(choice, one.Calls),
                RecursivePart { IsSum: true, Recursives: [var sum] } => FormatSum(sum.Calls, names[0], FormatConstant, isWhole: true),
                RecursivePart recursive => FormatRecursive(recursive, GroupOf(recursive, parts)),
                _ => throw new ArgumentException($"{part.GetType().Name} is no part of a fractal"),
            };
            names.Add(writer.NextObjectName());
            writer.AppendLine($"{names[^1]}. {value}");
        }
    }

    private string FormatFlat(Choice choice, ImmutableArray<RecursiveCall> calls)
    {
        DeclareSeed(FormatSeed(choice));
        return FormatChoice(choice, calls.Select(FormatConstant));
    }

    private static string FormatRecursive(RecursivePart part, Dictionary<int, string> group) => (part.Levels, part.Until) switch
    {
        ({ } levels, null) => FormattableString.Invariant($"{group[part.Root]} {levels}"),
        (null, { } until) => FormattableString.Invariant($"{group[part.Root]} until {until:R}"),
        (null, null) => group[part.Root],
        _ => throw FractalWriter.Fault(ErrorKind.Input, "a recursive ends both by its depth and by its size"),
    };

    /// <summary>Returns the names of recursives that call each other, and declares them if they are new.</summary>
    private Dictionary<int, string> GroupOf(RecursivePart part, ImmutableArray<FractalPart> parts)
    {
        if (_groups.Find(group => group.Part.HasRecursivesOf(part)) is { Names: { } known })
        {
            return known;
        }

        RecursiveCall[] calls = [.. part.Recursives.SelectMany(static recursive => recursive.Calls)];
        int[] heads =
        [
            .. parts.OfType<RecursivePart>().Where(other => other.HasRecursivesOf(part)).Select(static other => other.Root)
                .Concat(calls.Where(static call => call.LevelsLess > 0).Select(static call => call.Target))
                .Concat(Enumerable.Range(0, part.Recursives.Length)
                    .Except(calls.Where(static call => call.LevelsLess == 0).Select(static call => call.Target)))
                .Distinct().Order(),
        ];
        var constants = calls.Where(static call => call.IsConstant).Select(static call => call.Target).ToHashSet();
        var bases = new Dictionary<int, string>();
        foreach (var head in heads)
        {
            // In a body, the name of a base is the recursive.
            var basePart = part.Recursives[head].BasePart;
            var name = names[basePart];
            if (!constants.Add(basePart))
            {
                name = writer.NextObjectName();
                writer.AppendLine($"{name}. {names[basePart]}");
            }

            bases.Add(head, name);
        }

        string[] seeds =
        [
            .. part.Recursives.Select(static recursive => recursive.Choice).OfType<Choice>()
                .Where(static choice => choice.FirstLevels.IsEmpty).Select(FormatSeed).Distinct(),
        ];
        if (seeds.Length > 1)
        {
            throw FractalWriter.Fault(ErrorKind.Input, "recursives that call each other have choices of several seeds");
        }

        var group = heads.ToDictionary(static head => head, _ => writer.NextRecursiveName());
        var bodies = heads.Select(head => FormatBody(part, head, bases, isWhole: true)).ToArray();
        foreach (var seed in seeds)
        {
            DeclareSeed(seed);
        }

        writer.AppendLine($"{string.Join(", ", heads.Select(head => $"{group[head]}<{bases[head]}>"))}. {string.Join(", ", bodies)}");
        _groups.Add((part, group));
        return group;
    }

    private string FormatBody(RecursivePart part, int recursive, Dictionary<int, string> bases, bool isWhole)
    {
        if (++_depth > FractalLimits.Steps.Value)
        {
            throw FractalWriter.Fault(ErrorKind.Limit, $"a body has more than the limit of {FractalLimits.Steps.Value} sets on each other");
        }

        var (calls, choice) = (part.Recursives[recursive].Calls, part.Recursives[recursive].Choice);
        var body = choice is not null
            ? FormatChoice(choice, calls.Select(FormatTarget))
            : FormatSum(
                calls, bases.Values.First(), FormatTarget, isWhole, call => part.Recursives[call.Target].Choice is not null);
        _depth--;
        FractalWriter.RequireLength(body.Length);
        return isWhole || (choice is null && IsSetOnOne(calls)) ? body : $"({body})";

        string FormatTarget(RecursiveCall call) => call.IsConstant ? FormatConstant(call)
            : call.LevelsLess == 1 && bases.TryGetValue(call.Target, out var name) ? name
            : call.LevelsLess == 0 ? FormatBody(part, call.Target, bases, isWhole: false)
            : throw FractalWriter.Fault(ErrorKind.Input, "a recursive calls another one with more than one level less");
    }

    private static string FormatSeed(Choice choice) =>
        FormattableString.Invariant($"seed {choice.Seed}{(choice.IsByLevel ? " by level" : "")}");

    /// <summary>Declares the seed of the choices in the lines below, unless it is that already.</summary>
    private void DeclareSeed(string seed)
    {
        if (seed != _seed)
        {
            writer.AppendLine(seed);
            _seed = seed;
        }
    }

    private static string FormatChoice(Choice choice, IEnumerable<string> alternatives) => choice.FirstLevels.IsEmpty
        ? string.Join(" | ", choice.Weights.Zip(
            alternatives, static (weight, one) => FormattableString.Invariant($"{weight:R}: {one}")))
        : "level " + string.Join(" | ", choice.FirstLevels.Zip(choice.FirstLevels.Skip(1).Append(0), alternatives).Select(
            static one => FormattableString.Invariant($"{one.First}..{(one.Second > 0 ? one.Second - 1 : null)}: {one.Third}")));

    /// <summary>Tells whether calls are one set on one target, so that they need no parentheses.</summary>
    private static bool IsSetOnOne(ImmutableArray<RecursiveCall> calls) => !calls.IsEmpty && AreOfOneTarget(calls)
        && (!calls[0].IsConstant || calls.Length <= MaxSetLength);

    private static bool AreOfOneTarget(ImmutableArray<RecursiveCall> calls) =>
        calls.All(call => call.HasTargetOf(calls[0]));

    private string FormatConstant(RecursiveCall call) => names[call.Target];

    /// <summary>Formats calls as terms: those of the same target one after the other are a set. Without calls it is an empty set.</summary>
    private string FormatSum(ImmutableArray<RecursiveCall> calls, string anyName, Func<RecursiveCall, string> formatTarget, bool isWhole,
        Func<RecursiveCall, bool>? isChoice = null)
    {
        if (calls.IsEmpty)
        {
            return $"[] {anyName}";
        }

        var terms = new List<string>();
        // One term alone would be steps on it, and no sum, where it is all of an object.
        var isOneTarget = isWhole && AreOfOneTarget(calls);
        for (var i = 0; i < calls.Length;)
        {
            var first = calls[i];
            var set = new List<string>();
            var maxLength = isOneTarget && i == 0 ? 1 : first.IsConstant ? MaxSetLength : int.MaxValue;
            for (; i < calls.Length && set.Count < maxLength && calls[i].HasTargetOf(first); i++)
            {
                set.Add(calls[i].IsPlain ? "#" : writer.FormatMap(calls[i].Map, calls[i].Colour));
            }

            // A set or sum of calls that stands as it is would be part of the sum around it.
            var isWithin = first.LevelsLess == 0 && isChoice?.Invoke(first) != true;
            terms.Add(set is ["#"] && !isWithin ? formatTarget(first) : $"[{string.Join(", ", set)}] {formatTarget(first)}");
        }

        return string.Join(" + ", terms);
    }
}
