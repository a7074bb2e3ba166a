using System.Collections.Immutable;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Parsing.Text;

namespace FractalEngine.Parsing.Fdo;

/// <summary>Parses the recursives of fractal files: those that repeat sets over a base, and those that call each other.</summary>
public abstract class RecursiveParser : ObjectParser
{
    private protected RecursiveParser(SourceText source, FractalNumberList? numbers, bool keepsSums)
        : base(source, numbers, keepsSums)
    {
    }

    /// <summary>
    /// Parses <c>z&lt;x&gt;. object</c>, or recursives that call each other, with commas between them: the name of a base in an object
    /// is the recursive with one level less.
    /// </summary>
    private protected bool ParseRecursives(Cursor cursor, out Cursor rest)
    {
        if (!ParseHead(cursor, out var head, out rest))
        {
            return false;
        }

        var heads = new List<RecursiveHead>(1) { head };
        while (ParseComma(rest, out rest))
        {
            if (!ParseHead(rest, out head, out rest))
            {
                return false;
            }

            heads.Add(head);
        }

        if (!ParseChar(rest, '.', out rest))
        {
            return false;
        }

        var bodies = new List<(DeclaredObject Value, Cursor Start)>(heads.Count);
        Calls = [];
        Heads = heads;
        foreach (var (i, one) in heads.Index())
        {
            Calls.TryAdd(one.BaseName, new(Bases.Parts.AddCall(i), DeclaredSteps.None));
        }

        do
        {
            if (!ParseBlanks(rest, out var start) || !ParseAny(start, out var body, out rest))
            {
                Calls = null;
                return false;
            }

            bodies.Add((body, start));
        }
        while (ParseComma(rest, out rest));
        Calls = null;
        var values = FindBases(heads);
        if (bodies.Count != heads.Count)
        {
            var expected = heads.Count == 1 ? "1 recursive has 1 body" : FormattableString.Invariant(
                $"{heads.Count} recursives have {heads.Count} bodies, with commas between them");
            throw Error(cursor, FormattableString.Invariant($"{expected}: found {bodies.Count}"));
        }

        if (bodies is [var (only, onlyStart)] && !HasCallInParts(only))
        {
            AddLinear(heads[0], values[0], only, onlyStart);
        }
        else
        {
            AddJoint(heads, values, bodies);
        }

        return true;
    }

    /// <summary>Parses a recursive and its base: <c>z&lt;x&gt;</c>.</summary>
    private bool ParseHead(Cursor cursor, out RecursiveHead head, out Cursor rest)
    {
        head = default;
        return ParseName(cursor, "a declaration", out var name, out rest) && ParseChar(rest, '<', out var baseStart)
            && ParseName(baseStart, "the name of the base object", out var baseName, out rest) && ParseChar(rest, '>', out rest)
            && Set(ref head, new(name, baseName, cursor, baseStart));
    }

    private bool ParseComma(Cursor cursor, out Cursor rest)
    {
        ParseBlanks(cursor, out var comma);
        rest = cursor;
        return comma.Current == ',' && ParseBlanks(comma.Advance(1), out rest);
    }

    private List<DeclaredObject> FindBases(List<RecursiveHead> heads)
    {
        var values = new List<DeclaredObject>(heads.Count);
        var names = new HashSet<string>();
        foreach (var head in heads)
        {
            var value = Names.FindObject(head.BaseStart, head.BaseName);
            ThrowIf(Bases.IsInfinite(value), head.BaseStart, $"the base '{head.BaseName}' is infinite: give it a depth");
            if (!names.Add(head.BaseName))
            {
                throw Error(head.BaseStart, $"the base '{head.BaseName}' is that of another recursive already: bases have different names");
            }

            values.Add(value);
        }

        return values;
    }

    /// <summary>Tells whether a body has calls elsewhere than at its end, below all its sets.</summary>
    private bool HasCallInParts(DeclaredObject body) => Bases.Parts.HasCalls(body.Part) && !Bases.Parts.IsCall(body.Part);

    /// <summary>Adds a recursive that repeats sets over its base, which are one round.</summary>
    private void AddLinear(RecursiveHead head, DeclaredObject baseObject, DeclaredObject body, Cursor bodyStart)
    {
        var (name, baseName) = (head.Name, head.BaseName);
        var isCall = Bases.Parts.IsCall(body.Part);
        if (!isCall && !body.IsDerivedFrom(baseObject))
        {
            throw Error(bodyStart, $"the body of the recursive '{name}' is not built on its base '{baseName}'");
        }

        var stepCount = body.Steps.Count - (isCall ? 0 : baseObject.Steps.Count);
        ThrowIf(stepCount == 0, bodyStart, $"the recursive '{name}' adds no transformations to its base '{baseName}'");
        RequireFiniteBody(head, body, bodyStart);
        RequireLimit(
            body.Steps.LevelCount - (isCall ? 0 : baseObject.Steps.LevelCount), FractalLimits.Levels.Value, "the fractal", "levels",
            bodyStart);
        RequireRepeatedSteps(stepCount, bodyStart);
        Names.Add(head.Start, name, new DeclaredRecursive(baseObject, body.Steps.Take(stepCount)) { Names = [name] });
    }

    /// <summary>Adds recursives that call themselves and each other.</summary>
    private void AddJoint(List<RecursiveHead> heads, List<DeclaredObject> bases, List<(DeclaredObject Value, Cursor Start)> bodies)
    {
        foreach (var (head, body) in heads.Zip(bodies))
        {
            RequireFiniteBody(head, body.Value, body.Start);
        }

        ImmutableArray<int> parts = [.. bodies.Select(body => Bases.PartOf(body.Value))];
        if (!parts.Any(Bases.Parts.HasCalls))
        {
            throw Error(bodies[0].Start, "no recursive has a base in its body: its name there is the recursive with one level less");
        }

        var recursives = Bases.Parts.CreateRecursives(
            [.. bases.Select(Bases.PartOf)], parts, index => bodies[index].Value.IsName);
        // Each of them is a part that holds all.
        RequireRepeatedSteps(
            heads.Count * recursives.Sum(static recursive => recursive.Calls.Length + 1L), bodies[0].Start,
            "calls of recursives that call each other, times the number of these");
        ImmutableArray<string> names = [.. heads.Select(static head => head.Name)];
        foreach (var (i, head) in heads.Index())
        {
            Names.Add(head.Start, head.Name, new DeclaredJointRecursive(Bases.Parts, recursives, i) { Names = names });
        }
    }

    private void RequireFiniteBody(RecursiveHead head, DeclaredObject body, Cursor start)
    {
        ThrowIf(Bases.IsInfinite(body), start, $"the body of the recursive '{head.Name}' is infinite: give the recursive in it a depth");
    }
}
