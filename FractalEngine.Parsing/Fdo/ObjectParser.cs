using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Generation;
using FractalEngine.Parsing.Text;
using FractalEngine.Parsing.Text.Grammar;

namespace FractalEngine.Parsing.Fdo;

/// <summary>Parses the objects of fractal files: base meshes, sets on objects, sums, and recursives at a depth.</summary>
public abstract class ObjectParser : MapSetParser
{
    private const int MaxParentheses = 32;
    private const string LevelWord = "level";

    private static readonly DeclaredObject EmptyObject = new(0, DeclaredSteps.None);

    private long _sumTermCount;
    private long _repeatedStepCount;
    private int _parentheses;
    private int _alternatives;
    private (int Number, bool IsByLevel) _seed;
    private string? _declared;

    /// <summary>Parses the number of an alternative, which may depend on that of the one before: 0 for the first one.</summary>
    private delegate bool NumberParser(Cursor cursor, double previous, out double number, out Cursor rest);

    private protected ObjectParser(SourceText source, FractalNumberList? numbers, bool keepsSums)
        : base(source, numbers, keepsSums)
    {
    }

    /// <summary>Counts steps and calls that are listed once more.</summary>
    private protected void RequireRepeatedSteps(long count, Cursor cursor, string things = "steps in all recursives and sums") =>
        RequireLimit(_repeatedStepCount += count, ParsingLimits.RepeatedSteps.Value, "the file", things, cursor);

    /// <summary>While the bodies of recursives are read, what the names of their bases are: calls. Null elsewhere.</summary>
    private protected Dictionary<string, DeclaredObject>? Calls { get; set; }

    /// <summary>The recursives that were declared last.</summary>
    private protected List<RecursiveHead> Heads { get; set; } = [];

    /// <summary>Begins the declaration of an object with a name, which does not know itself. Always true.</summary>
    private protected bool BeginObject(string name) => Set(ref _declared, name);

    /// <summary>Parses <c>seed 7</c> or <c>seed 7 by level</c>, by which all choices below are made.</summary>
    private protected bool ParseSeed(Cursor cursor, out Cursor rest)
    {
        rest = cursor;
        if (!ParseWordAndBlank(cursor, "seed", out var start) || !ParseInteger(start, "a seed", out var number, out rest))
        {
            return false;
        }

        ParseBlanks(rest, out var word);
        ThrowIf(number > Choice.MaxSeed, start, FormattableString.Invariant($"a seed is at most {Choice.MaxSeed}"));
        var isByLevel = ParseWord(word, "by", out var next);
        _seed = (number, isByLevel);
        return !isByLevel || (ParseBlanks(next, out next) && ParseWord(next, "level", out rest));
    }

    /// <summary>
    /// Parses an object: a sum, or several of which one stands there, by chance with weights, <c>3: a | 1: b + c</c>, or by the level,
    /// <c>level 0..2: a | 3..: b</c>.
    /// </summary>
    private protected bool ParseAny(Cursor cursor, out DeclaredObject value, out Cursor rest)
    {
        if (!IsWeight(cursor.Rest))
        {
            return ParseSum(cursor, out value, out rest);
        }

        value = EmptyObject;
        var isByLevel = ParseLevelWord(cursor, out var first);
        var numbers = new List<double>();
        var alternatives = new List<int>();
        _alternatives++;
        var isParsed = ParseAlternatives(first, isByLevel ? new NumberParser(ParseLevels) : ParseWeight, numbers, alternatives, out rest);
        _alternatives--;
        if (!isParsed)
        {
            return false;
        }

        ThrowIf(
            isByLevel ? numbers[^1] <= int.MaxValue : !(numbers.Sum() is > 0 and < double.PositiveInfinity), cursor,
            isByLevel ? "the last alternative of a choice by level has no end, as in '3..: box'"
                : "the weights of a choice are all 0, or too large to add");
        var choice = isByLevel
            ? Choice.OfLevels([0, .. numbers.SkipLast(1).Select(static next => (int)next)])
            : new Choice([.. numbers], _seed.Number, _seed.IsByLevel);
        value = new(Bases.Parts.AddChoice([.. alternatives], choice, isOfBody: Calls is not null), DeclaredSteps.None);
        return true;
    }

    /// <summary>Parses the word before the levels of a choice, which may be the name of an object instead.</summary>
    private bool ParseLevelWord(Cursor cursor, out Cursor rest)
    {
        if (Names.HasObject(LevelWord) || !ParseWord(cursor, LevelWord, out rest) || !ParseBlanks(rest, out rest)
            || !char.IsAsciiDigit(rest.Current))
        {
            rest = cursor;
            return false;
        }

        ThrowIf(Calls is null, cursor, "a choice by level stands in the body of a recursive, whose levels it counts");
        return true;
    }

    /// <summary>Parses the levels of an alternative, and returns the first one behind them: infinite where they have no end.</summary>
    private bool ParseLevels(Cursor cursor, double first, out double next, out Cursor rest)
    {
        next = double.PositiveInfinity;
        if (!ParseInteger(cursor, "a level", out var from, out rest))
        {
            return false;
        }

        ThrowIf(from != first, cursor, first < double.PositiveInfinity
            ? FormattableString.Invariant($"the levels of a choice follow each other: expected {first} here, not {from}")
            : "the levels before have no end, so that nothing comes behind them");
        var last = from;
        if (rest.Rest.StartsWith("..", StringComparison.Ordinal))
        {
            rest = rest.Advance(2);
            if (!char.IsAsciiDigit(rest.Current))
            {
                return true;
            }

            var end = rest;
            ParseInteger(end, "a level", out last, out rest);
            ThrowIf(last < from, end, "the last level of an alternative is not before its first one");
        }

        ThrowIf(last >= int.MaxValue, cursor, "a level is less than 2147483647");
        next = last + 1.0;
        return true;
    }

    private bool ParseWeight(Cursor cursor, double previous, out double weight, out Cursor rest)
    {
        var isParsed = ParseExpression(cursor, out weight, out rest);
        ThrowIf(isParsed && weight < 0, cursor, FormattableString.Invariant($"a weight is not negative, and this one is {weight:R}"));
        return isParsed;
    }

    private bool ParseAlternatives(
        Cursor cursor, NumberParser parseNumber, List<double> numbers, List<int> alternatives, out Cursor rest)
    {
        for (var start = cursor; ; ParseBlanks(start.Advance(1), out start))
        {
            ThrowIf(!IsWeight(start.Rest), start, "each alternative of a choice has a weight and a colon, as in '1: box'");
            if (!parseNumber(start, numbers.LastOrDefault(), out var number, out rest) || !ParseBlanks(rest, out rest)
                || !ParseChar(rest, ':', out rest) || !ParseBlanks(rest, out rest)
                || !ParseSum(rest, out var alternative, out rest))
            {
                return false;
            }

            RequireLimit(alternatives.Count + 1, Choice.MaxAlternatives, "the choice", "alternatives", start);
            RequireLimit(++_sumTermCount, ParsingLimits.Names.Value, "the file", "terms of sums", start);
            RequireRepeatedSteps(alternative.Steps.Count, start);
            numbers.Add(number);
            alternatives.Add(Bases.PartOf(alternative));
            if (!ParseBlanks(rest, out start) || start.Current != '|')
            {
                return true;
            }
        }
    }

    /// <summary>Tells whether a text begins with a weight: what has a colon behind it.</summary>
    private static bool IsWeight(ReadOnlySpan<char> text)
    {
        var depth = 0;
        foreach (var character in text)
        {
            switch (character)
            {
                case ':' when depth == 0:
                    return true;
                case ')' or ',' when depth == 0:
                case '\n' or '\r' or '[' or '"' or '|' or '+':
                    return false;
            }

            depth += character == '(' ? 1 : character == ')' ? -1 : 0;
        }

        return false;
    }

    /// <summary>Parses one thing, or several at one place with plus signs between them.</summary>
    private bool ParseSum(Cursor cursor, out DeclaredObject value, out Cursor rest)
    {
        if (!ParseObject(cursor, out value, out rest))
        {
            return false;
        }

        List<DeclaredObject>? terms = null;
        while (ParseBlanks(rest, out var sign) && sign.Current == '+')
        {
            terms ??= [value];
            if (!ParseBlanks(sign.Advance(1), out var start) || !ParseObject(start, out var term, out rest))
            {
                return false;
            }

            RequireLimit(++_sumTermCount, ParsingLimits.Names.Value, "the file", "terms of sums", start);
            RequireRepeatedSteps(term.Steps.Count, start);
            terms.Add(term);
        }

        value = terms is null ? value
            : new(Bases.Parts.AddSum([.. terms.Select(Bases.PartOf)], index => terms[index].IsName), DeclaredSteps.None);
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
        if (!ParseBase(rest, out value, out rest) && !ParseParentheses(rest, out value, out rest)
            && !(ParseReference(rest, out value, out rest) && Set(ref value, value with { IsName = true })))
        {
            return false;
        }

        if (sets.Count > 0)
        {
            var steps = sets.AsEnumerable().Reverse().Aggregate(value.Steps, (inner, step) => inner.Prepend(step));
            value = new(value.Part, steps);
        }

        RequireStepLimits(value.Steps, cursor);
        return true;
    }

    /// <summary>Parses a base mesh, <c>"file.obj"</c>, which may have a material: <c>box material "bark.mtl" "Oak"</c>.</summary>
    private bool ParseBase(Cursor cursor, out DeclaredObject value, out Cursor rest)
    {
        value = EmptyObject;
        MaterialReference? material;
        if (ParseString(cursor, "the name of a mesh in quotes", out var file, out rest))
        {
            var kind = FileKinds.FromName(file);
            ThrowIf(kind is not (FileKind.Mesh or FileKind.Fractal), cursor,
                $"expected the name of a mesh ({FileKinds.MeshEndings}) or fractal (.fdo): that is the base of a fractal");
            if (!ParseMaterial(rest, out material, out rest))
            {
                return false;
            }

            ThrowIf(
                material is not null && kind == FileKind.Fractal, cursor, "a fractal has the materials of its meshes: give one to these");
            value = Bases.Add(file, cursor.Offset, material);
            return true;
        }

        // A shape without a material is known by its name.
        if (!ParseName(cursor, FractalMistakes.ObjectName, out var name, out var behind) || Names.HasObject(name)
            || Calls?.ContainsKey(name) == true || !BaseShapes.TryFind(name, out _)
            || !ParseMaterial(behind, out material, out behind) || material is null)
        {
            return false;
        }

        value = Bases.Add(name, cursor.Offset, material);
        rest = behind;
        return true;
    }

    /// <summary>Parses the material of a base mesh, where there is one.</summary>
    private bool ParseMaterial(Cursor cursor, out MaterialReference? material, out Cursor rest)
    {
        material = null;
        rest = cursor;
        if (!ParseBlanks(cursor, out var start) || start.Offset == cursor.Offset || !ParseWord(start, "material", out var next)
            || !ParseBlanks(next, out var name))
        {
            return true;
        }

        if (!ParseString(name, "the name of a material file in quotes", out var file, out rest))
        {
            return false;
        }

        ThrowIf(!file.EndsWith(".mtl", StringComparison.OrdinalIgnoreCase), name, "expected the name of a material file (.mtl)");
        ParseBlanks(rest, out var second);
        material = new(file, null, name.Offset);
        if (second.Current == '"' && ParseString(second, "the name of a material in quotes", out var within, out rest))
        {
            material = material with { Name = within };
        }

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
        var isParsed = ParseBlanks(cursor.Advance(1), out var start) && ParseAny(start, out value, out rest)
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
        var call = Calls?.GetValueOrDefault(name);
        if (IsAtEndOfTerm(depthStart))
        {
            value = call ?? FindObject(cursor, name);
            return true;
        }

        if (depthStart.Current == '-' && char.IsAsciiDigit(depthStart.Peek(1)))
        {
            throw Error(depthStart, "the depth of a recursive must not be negative");
        }

        if (depthStart.Offset > rest.Offset && ParseWord(depthStart, "until", out var word))
        {
            return ParseUntil(cursor, name, depthStart, word, out value, out rest);
        }

        if ((depthStart.Current == '(' ? !Names.IsRecursive(name) : depthStart.Offset == rest.Offset)
            || !ParseDepth(depthStart, out var depth, out rest))
        {
            return Fail(depthStart, SyntaxFailure.EndOfLine);
        }

        var recursive = FindRecursion(cursor, name, depthStart);
        if (depth > FractalLimits.Depth.Value)
        {
            throw Error(depthStart, $"the depth is more than the limit of {FractalLimits.Depth.Value}", isLimitExceeded: true);
        }

        RequireRepeatedSteps(recursive.CallCount, cursor);
        value = recursive.WithDepth((int)depth);
        if (depthStart.Current != '(')
        {
            Numbers?.AddDepth(name, depthStart, rest, (int)depth);
        }

        return true;
    }

    /// <summary>Returns the recursive with a name, which has a depth or an end by size behind it.</summary>
    private DeclaredRecursion FindRecursion(Cursor cursor, string name, Cursor end) => Calls?.ContainsKey(name) == true
        ? throw Error(end, $"'{name}' is here the recursive with one level less, so it has no depth of its own")
        : FindObject(cursor, name) as DeclaredRecursion ?? throw Error(end, $"'{name}' is no recursive, so it has no depth");

    /// <summary>Parses the end of a recursive by its size, <c>z until 0.02</c>, behind the keyword.</summary>
    private bool ParseUntil(Cursor cursor, string name, Cursor keyword, Cursor behind, out DeclaredObject value, out Cursor rest)
    {
        value = EmptyObject;
        if (!ParseBlanks(behind, out var start) || !ParseProduct(start, out var length, out rest))
        {
            rest = behind;
            return false;
        }

        var recursive = FindRecursion(cursor, name, keyword);
        ThrowIf(!(length > 0), start, FormattableString.Invariant($"a recursive ends at a size above 0, and this one is {length:R}"));
        var (recursives, index) = recursive.GetRecursives(Bases.Parts);
        RequireRepeatedSteps(recursives.Sum(static one => one.Calls.Length), cursor);
        if (RecursiveCycles.FindGrowing(recursives) is { } cycle)
        {
            // Sets of sets, and sums and choices in sets, are recursives without names.
            var names = cycle.Where(one => one < recursive.Names.Length).Select(one => $"'{recursive.Names[one]}'").ToArray();
            throw Error(keyword, names is [var only]
                ? $"{only} calls itself without getting smaller, so that it never ends by its size"
                : $"{string.Join(", ", names)} call each other without getting smaller, so that they never end by their size");
        }

        value = new(Bases.Parts.AddRecursive(recursives, index, null, length), DeclaredSteps.None);
        return true;
    }

    /// <summary>Returns the object with a name. One that is being declared has a mistake of its own.</summary>
    private DeclaredObject FindObject(Cursor cursor, string name)
    {
        if (!Names.HasObject(name) && Calls is not null && Heads.Find(head => head.Name == name) is { Name: not null } called)
        {
            throw Error(
                cursor, $"within its own declaration, the recursive '{name}' is called by the name of its base, '{called.BaseName}'");
        }

        return Names.HasObject(name) || Calls is not null || name != _declared ? Names.FindObject(cursor, name)
            : throw Error(cursor, $"'{name}' is declared by itself: what repeats itself is a recursive, as in '{name}<box>. [t.] box'");
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
        || (cursor.Current == ',' && Calls is not null) || (cursor.Current == '|' && _alternatives > 0);

    private void RequireStepLimits(DeclaredSteps steps, Cursor cursor)
    {
        if (steps.Count > FractalLimits.Steps.Value || steps.NestingDepth > FractalLimits.Nesting.Value)
        {
            var limits = $"{FractalLimits.Steps.Value} steps, or of {FractalLimits.Nesting.Value} recursives inside each other";
            throw Error(cursor, $"the object has more than the limit of {limits}", isLimitExceeded: true);
        }
    }
}
