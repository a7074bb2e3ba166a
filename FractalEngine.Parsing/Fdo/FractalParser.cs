using System.Collections.Immutable;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Parsing.Text;
using FractalEngine.Parsing.Text.Grammar;

namespace FractalEngine.Parsing.Fdo;

/// <summary>
/// Reads fractal files (paper §4.2.2): vectors, transformation functions, objects and recursives, and the one result marked by
/// <c>&lt;$&gt;</c>. The grammar is in docs/manual.md. Nothing is expanded, so the result is as small as the file.
/// </summary>
public sealed class FractalParser : MapSetParser
{
    private const int MaxParentheses = 32;

    private static readonly DeclaredObject EmptyObject = new(0, DeclaredSteps.None);

    private (Composition Composition, int Offset)? _composition;
    private (DeclaredObject Object, int Offset)? _result;
    private bool _hasDeclaration;
    private long _repeatedStepCount;
    private long _termCount;
    private int _parentheses;

    // While the bodies of recursives are read, their bases are the calls of these.
    private Dictionary<string, DeclaredObject>? _calls;

    private protected override string? Explain(SyntaxFailure failure) => ExplainOutput(failure) ?? FractalMistakes.Explain(failure);

    private FractalParser(SourceText source, FractalNumberList? numbers)
        : base(source, numbers)
    {
    }

    /// <summary>Parses a whole fractal file. The file of the base mesh is not read.</summary>
    /// <param name="source">Text of the file.</param>
    /// <param name="values">Numbers that take the place of those that the file gives to names; null for none.</param>
    /// <exception cref="SourceException">The text is not a fractal, or has no valid meaning.</exception>
    public static ParsedFractal Parse(SourceText source, IReadOnlyDictionary<string, double>? values = null) =>
        new FractalParser(source, null) { Overrides = values }.ParseFile();

    /// <summary>Parses a file, and lists its numbers.</summary>
    internal static ImmutableArray<FractalNumber> FindNumbers(SourceText source)
    {
        var numbers = new FractalNumberList();
        new FractalParser(source, numbers).ParseFile();
        return numbers.Complete();
    }

    private ParsedFractal ParseFile()
    {
        for (var cursor = Source.Start; !cursor.IsAtEnd;)
        {
            if (!ParseLine(cursor, out cursor))
            {
                throw SyntaxError();
            }
        }

        RequireVectors();
        if (_result is not { } result)
        {
            throw _hasDeclaration
                ? Source.Error(Source.Text.TrimEnd().Length, "the fractal has no result: expected a declaration '<$>. object'")
                : Source.Error(0, "the fractal declares nothing");
        }

        var steps = result.Object.Steps;
        var description = Bases.Parts.Describe(
            result.Object.Part, steps.Take(steps.Count), _composition?.Composition ?? Composition.Affine, out var meshes);
        RequirePartLimits(description, meshes.Length, result.Offset);
        if (FractalCheck.FindCompositionFault(description) is { } fault)
        {
            throw Source.Error(result.Offset, fault);
        }

        return new(Source, description, [.. meshes.Select(mesh => Bases.References[mesh])], result.Offset)
        {
            NumberNames = [.. NumberNames],
            Warnings = Hints,
        };
    }

    private bool ParseLine(Cursor cursor, out Cursor rest)
    {
        ParseBlanks(cursor, out var start);
        return ParseComment(start, out rest)
            || ((IsAtEndOfLine(start) || ParseDeclaration(start, out rest)) && ParseEndOfLine(rest, out rest));
    }

    private bool ParseDeclaration(Cursor cursor, out Cursor rest)
    {
        _hasDeclaration = true;
        return ParseVectorDeclaration(cursor, out rest)
            || ParseResult(cursor, out rest)
            || ParseComposition(cursor, out rest)
            || ParseValueDeclaration(cursor, out rest)
            || ParseMatrix(cursor, out rest)
            || ParseFunction(cursor, out rest)
            || ParseRecursives(cursor, out rest)
            || ParseObjectDeclaration(cursor, out rest);
    }

    /// <summary>Parses the choice <c>composition affine</c> or <c>composition componentwise</c>.</summary>
    private bool ParseComposition(Cursor cursor, out Cursor rest)
    {
        if (!ParseWord(cursor, "composition", out rest) || !ParseBlanks(rest, out var word) || word.Offset == rest.Offset
            || !ParseCompositionName(word, out var composition, out rest))
        {
            return false;
        }

        if (_composition is { } first)
        {
            throw Error(cursor, $"the composition is declared twice, first in line {Source.LineOf(first.Offset)}");
        }

        _composition = (composition, cursor.Offset);
        return true;
    }

    private bool ParseCompositionName(Cursor cursor, out Composition composition, out Cursor rest)
    {
        composition = Composition.Affine;
        if (ParseWord(cursor, "affine", out rest))
        {
            return true;
        }

        composition = Composition.Componentwise;
        return ParseWord(cursor, "componentwise", out rest);
    }

    /// <summary>Parses the result of the file: <c>&lt;$&gt;. object</c>.</summary>
    private bool ParseResult(Cursor cursor, out Cursor rest)
    {
        rest = cursor;
        if (!cursor.Rest.StartsWith("<$>", StringComparison.Ordinal))
        {
            return Fail(cursor, "'<$>'");
        }

        if (!ParseChar(cursor.Advance(3), '.', out rest) || !ParseBlanks(rest, out rest) || !ParseSum(rest, out var value, out rest))
        {
            return false;
        }

        if (_result is { } first)
        {
            throw Error(cursor, $"the result '<$>' is declared twice, first in line {Source.LineOf(first.Offset)}");
        }

        RequireLimit(value.Steps.LevelCount, FractalLimits.Levels.Value, "the fractal", "levels", cursor);
        var digits = FractalSteps.EstimateDigits(value.Steps.Take(value.Steps.Count));
        RequireLimit(digits, FractalLimits.Digits.Value, "the number of instances", "digits", cursor);
        _result = (value, cursor.Offset);
        return true;
    }

    private void RequirePartLimits(FractalDescription description, int baseCount, int offset)
    {
        if (baseCount > ParsingLimits.BaseFiles.Value)
        {
            throw Source.Error(
                offset, $"the fractal has more than the limit of {ParsingLimits.BaseFiles.Value} base meshes", isLimitExceeded: true);
        }

        if (!description.Parts.IsEmpty && FractalLimits.FindExceeded(description) is var (limit, things))
        {
            throw Source.Error(offset, $"the fractal has more than the limit of {limit.Value} {things}", isLimitExceeded: true);
        }
    }

    /// <summary>
    /// Parses <c>z&lt;x&gt;. object</c>, or recursives that call each other, with commas between them: the name of a base in an object
    /// is the recursive with one level less.
    /// </summary>
    private bool ParseRecursives(Cursor cursor, out Cursor rest)
    {
        var heads = new List<RecursiveHead>();
        rest = cursor;
        do
        {
            if (!ParseHead(rest, out var head, out rest))
            {
                return false;
            }

            heads.Add(head);
        }
        while (ParseComma(rest, out rest));
        if (!ParseChar(rest, '.', out rest))
        {
            return false;
        }

        var bodies = new List<(DeclaredObject Value, Cursor Start)>();
        _calls = [];
        foreach (var (i, head) in heads.Index())
        {
            _calls.TryAdd(head.BaseName, new(Bases.Parts.AddCall(i), DeclaredSteps.None));
        }

        do
        {
            if (!ParseBlanks(rest, out var start) || !ParseSum(start, out var body, out rest))
            {
                _calls = null;
                return false;
            }

            bodies.Add((body, start));
        }
        while (ParseComma(rest, out rest));
        _calls = null;
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
        var values = new List<DeclaredObject>();
        foreach (var (i, head) in heads.Index())
        {
            var value = Names.FindObject(head.BaseStart, head.BaseName);
            if (Bases.IsInfinite(value))
            {
                throw Error(head.BaseStart, $"the base '{head.BaseName}' is infinite: give it a depth");
            }

            if (heads.FindIndex(other => other.BaseName == head.BaseName) < i)
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
        if (stepCount == 0)
        {
            throw Error(bodyStart, $"the recursive '{name}' adds no transformations to its base '{baseName}'");
        }

        RequireFiniteBody(head, body, bodyStart);
        RequireLimit(
            body.Steps.LevelCount - (isCall ? 0 : baseObject.Steps.LevelCount), FractalLimits.Levels.Value, "the fractal", "levels",
            bodyStart);
        RequireLimit(_repeatedStepCount += stepCount, ParsingLimits.RepeatedSteps.Value, "the file", "steps in all recursives", bodyStart);
        Names.Add(head.Start, name, new DeclaredRecursive(baseObject, body.Steps.Take(stepCount)));
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

        var recursives = Bases.Parts.CreateRecursives([.. bases.Select(Bases.PartOf)], parts);
        foreach (var (i, head) in heads.Index())
        {
            Names.Add(head.Start, head.Name, new DeclaredJointRecursive(Bases.Parts, recursives, i));
        }
    }

    private void RequireFiniteBody(RecursiveHead head, DeclaredObject body, Cursor start)
    {
        if (Bases.IsInfinite(body))
        {
            throw Error(start, $"the body of the recursive '{head.Name}' is infinite: give the recursive in it a depth");
        }
    }

    /// <summary>Parses a named object: <c>name. object</c>.</summary>
    private bool ParseObjectDeclaration(Cursor cursor, out Cursor rest)
    {
        if (!ParseName(cursor, "a declaration", out var name, out rest) || !ParseChar(rest, '.', out rest)
            || !ParseBlanks(rest, out rest) || (rest.Current == '(' && !ParenthesizedObject.Begins(rest.Rest))
            || !ParseSum(rest, out var value, out rest))
        {
            return false;
        }

        Names.Add(cursor, name, value);
        return true;
    }

    /// <summary>Parses an object: one thing, or several at one place with plus signs between them.</summary>
    private bool ParseSum(Cursor cursor, out DeclaredObject value, out Cursor rest)
    {
        if (!ParseObject(cursor, out value, out rest))
        {
            return false;
        }

        List<int>? terms = null;
        while (ParseBlanks(rest, out var sign) && sign.Current == '+')
        {
            terms ??= [Bases.PartOf(value)];
            if (!ParseBlanks(sign.Advance(1), out var start) || !ParseObject(start, out var term, out rest))
            {
                return false;
            }

            RequireLimit(++_termCount, ParsingLimits.Names.Value, "the file", "terms of sums", start);
            terms.Add(Bases.PartOf(term));
        }

        value = terms is null ? value : new(Bases.Parts.AddSum([.. terms]), DeclaredSteps.None);
        return true;
    }

    /// <summary>
    /// Parses <c>"file.obj"</c>, <c>(object)</c>, <c>name</c> or <c>name depth</c>, with any number of sets
    /// <c>[transformations]</c> before it. It is a
    /// loop, not a recursion, so that no file can exhaust the stack.
    /// </summary>
    private bool ParseObject(Cursor cursor, out DeclaredObject value, out Cursor rest)
    {
        var sets = new List<FractalStep>();
        TransformationSet set;
        for (rest = cursor; rest.Current == '['; sets.Add(set))
        {
            if (!ParseSet(rest, out set, out rest) || !ParseBlanks(rest, out rest))
            {
                value = EmptyObject;
                return false;
            }
        }

        Fail(rest, "'['");
        if (!ParseBaseFile(rest, out value, out rest) && !ParseParentheses(rest, out value, out rest)
            && !ParseReference(rest, out value, out rest))
        {
            return false;
        }

        if (sets.Count > 0)
        {
            var steps = sets.AsEnumerable().Reverse().Aggregate(value.Steps, (inner, step) => inner.Prepend(step));
            value = new(value.Part, steps) { Origin = value };
        }

        RequireStepLimits(value.Steps, cursor);
        return true;
    }

    private bool ParseBaseFile(Cursor cursor, out DeclaredObject value, out Cursor rest)
    {
        value = EmptyObject;
        if (!ParseString(cursor, "the name of a mesh in quotes", out var file, out rest))
        {
            return false;
        }

        value = FileKinds.FromName(file) is FileKind.Mesh or FileKind.Fractal ? Bases.Add(file, cursor.Offset) : throw Error(
            cursor, $"expected the name of a mesh ({FileKinds.MeshEndings}) or fractal (.fdo): that is the base of a fractal");
        return true;
    }

    /// <summary>Parses an object in parentheses.</summary>
    private bool ParseParentheses(Cursor cursor, out DeclaredObject value, out Cursor rest)
    {
        value = EmptyObject;
        rest = cursor;
        if (cursor.Current != '(')
        {
            return false;
        }

        RequireLimit(++_parentheses, MaxParentheses, "the object", "parentheses inside each other", cursor);
        var isParsed = ParseBlanks(cursor.Advance(1), out var start) && ParseSum(start, out value, out rest)
            && ParseBlanks(rest, out rest) && ParseChar(rest, ')', out rest);
        _parentheses--;
        return isParsed;
    }

    private bool ParseReference(Cursor cursor, out DeclaredObject value, out Cursor rest)
    {
        value = EmptyObject;
        if (!ParseName(cursor, FractalMistakes.ObjectName, out var name, out rest))
        {
            return false;
        }

        // The line may still be another kind of declaration, so names are resolved only once the syntax fits.
        ParseBlanks(rest, out var depthStart);
        var call = _calls?.GetValueOrDefault(name);
        if (IsAtEndOfTerm(depthStart))
        {
            value = call ?? Names.FindObject(cursor, name);
            return true;
        }

        if (depthStart.Current == '-' && char.IsAsciiDigit(depthStart.Peek(1)))
        {
            throw Error(depthStart, "the depth of a recursive must not be negative");
        }

        if ((depthStart.Current == '(' ? !Names.IsRecursive(name) : depthStart.Offset == rest.Offset)
            || !ParseDepth(depthStart, out var depth, out rest))
        {
            return Fail(depthStart, SyntaxFailure.EndOfLine);
        }

        if (call is not null)
        {
            throw Error(depthStart, $"'{name}' is here the recursive with one level less, so it has no depth of its own");
        }

        if (Names.FindObject(cursor, name) is not DeclaredRecursion recursive)
        {
            throw Error(depthStart, $"'{name}' is no recursive, so it has no depth");
        }

        if (depth > FractalLimits.Depth.Value)
        {
            throw Error(depthStart, $"the depth is more than the limit of {FractalLimits.Depth.Value}", isLimitExceeded: true);
        }

        RequireLimit(
            _repeatedStepCount += recursive.CallCount, ParsingLimits.RepeatedSteps.Value, "the file", "steps in all recursives", cursor);
        value = recursive.WithDepth((int)depth);
        if (depthStart.Current != '(')
        {
            Numbers?.AddDepth(name, depthStart, rest, (int)depth);
        }

        return true;
    }

    /// <summary>Parses the depth of a recursive: an integer, or an expression in parentheses.</summary>
    private bool ParseDepth(Cursor cursor, out double depth, out Cursor rest)
    {
        if (cursor.Current != '(')
        {
            var isInteger = ParseInteger(cursor, "a depth", out var integer, out rest);
            depth = integer;
            return isInteger;
        }

        if (!ParseParenthesized(cursor, out depth, out rest))
        {
            return false;
        }

        return depth >= 0 && Math.Floor(depth) == depth ? true
            : throw Error(cursor, FormattableString.Invariant($"a depth is a whole number that is not negative, not {depth:R}"));
    }

    private bool IsAtEndOfTerm(Cursor cursor) =>
        IsAtEndOfLine(cursor) || cursor.Current == '+' || (cursor.Current == ')' && _parentheses > 0)
        || (cursor.Current == ',' && _calls is not null);

    private void RequireStepLimits(DeclaredSteps steps, Cursor cursor)
    {
        if (steps.Count > FractalLimits.Steps.Value || steps.NestingDepth > FractalLimits.Nesting.Value)
        {
            var limits = $"{FractalLimits.Steps.Value} steps, or of {FractalLimits.Nesting.Value} recursives inside each other";
            throw Error(cursor, $"the object has more than the limit of {limits}", isLimitExceeded: true);
        }
    }

    /// <summary>A recursive and its base, as they are declared.</summary>
    private readonly record struct RecursiveHead(string Name, string BaseName, Cursor Start, Cursor BaseStart);
}
