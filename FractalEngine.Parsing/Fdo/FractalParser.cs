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
    private static readonly DeclaredObject EmptyObject = new("", 0, DeclaredSteps.None);

    private (Composition Composition, int Offset)? _composition;
    private (DeclaredObject Object, int Offset)? _result;
    private bool _hasDeclaration;
    private long _repeatedStepCount;

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
        var description = new FractalDescription(steps.Take(steps.Count), _composition?.Composition ?? Composition.Affine);
        if (FractalCheck.FindCompositionFault(description) is { } fault)
        {
            throw Source.Error(result.Offset, fault);
        }

        return new(Source, description, result.Object.BaseFile, result.Object.BaseFileNameOffset, result.Offset)
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
            || ParseRecursive(cursor, out rest)
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

        if (!ParseChar(cursor.Advance(3), '.', out rest) || !ParseBlanks(rest, out rest) || !ParseObject(rest, out var value, out rest))
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

    /// <summary>Parses <c>z&lt;x&gt;. object</c>. The object must be built on x; what it adds to x is one round.</summary>
    private bool ParseRecursive(Cursor cursor, out Cursor rest)
    {
        if (!ParseName(cursor, "a declaration", out var name, out rest) || !ParseChar(rest, '<', out var baseStart)
            || !ParseName(baseStart, "the name of the base object", out var baseName, out rest) || !ParseChar(rest, '>', out rest)
            || !ParseChar(rest, '.', out rest) || !ParseBlanks(rest, out var bodyStart) || !ParseObject(bodyStart, out var body, out rest))
        {
            return false;
        }

        var baseObject = Names.FindObject(baseStart, baseName);
        RequireFinite(baseStart, baseName, baseObject);
        if (!body.IsDerivedFrom(baseObject))
        {
            throw Error(bodyStart, $"the body of the recursive '{name}' is not built on its base '{baseName}'");
        }

        var stepCount = body.Steps.Count - baseObject.Steps.Count;
        if (stepCount == 0)
        {
            throw Error(bodyStart, $"the recursive '{name}' adds no transformations to its base '{baseName}'");
        }

        if (body.Steps.LevelCount is null)
        {
            throw Error(bodyStart, $"the body of the recursive '{name}' is infinite: give the recursive in it a depth");
        }

        RequireLimit(
            body.Steps.LevelCount - baseObject.Steps.LevelCount, FractalLimits.Levels.Value, "the fractal", "levels", bodyStart);
        RequireLimit(_repeatedStepCount += stepCount, ParsingLimits.RepeatedSteps.Value, "the file", "steps in all recursives", bodyStart);
        Names.Add(cursor, name, new DeclaredRecursive(baseObject, body.Steps.Take(stepCount)));
        return true;
    }

    /// <summary>Parses a named object: <c>name. object</c>.</summary>
    private bool ParseObjectDeclaration(Cursor cursor, out Cursor rest)
    {
        if (!ParseName(cursor, "a declaration", out var name, out rest) || !ParseChar(rest, '.', out rest)
            || !ParseBlanks(rest, out rest) || !ParseObject(rest, out var value, out rest))
        {
            return false;
        }

        Names.Add(cursor, name, value);
        return true;
    }

    /// <summary>
    /// Parses <c>"file.obj"</c>, <c>name</c> or <c>name depth</c>, with any number of sets <c>[transformations]</c> before it. It is a
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
        if (!ParseBaseFile(rest, out value, out rest) && !ParseReference(rest, out value, out rest))
        {
            return false;
        }

        if (sets.Count > 0)
        {
            var steps = sets.AsEnumerable().Reverse().Aggregate(value.Steps, (inner, step) => inner.Prepend(step));
            value = new(value.BaseFile, value.BaseFileNameOffset, steps) { Origin = value };
        }

        RequireStepLimits(value.Steps, cursor);
        return true;
    }

    private bool ParseBaseFile(Cursor cursor, out DeclaredObject value, out Cursor rest)
    {
        var success = ParseString(cursor, "the name of a mesh in quotes", out var file, out rest);
        value = new(file, cursor.Offset, DeclaredSteps.None);
        return success && FileKinds.FromName(file) != FileKind.Mesh
            ? throw Error(cursor, $"expected the name of a mesh ({FileKinds.MeshEndings}): that is the base of a fractal")
            : success;
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
        if (IsAtEndOfLine(depthStart))
        {
            value = Names.FindObject(cursor, name);
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

        if (Names.FindObject(cursor, name) is not DeclaredRecursive recursive)
        {
            throw Error(depthStart, $"'{name}' is no recursive, so it has no depth");
        }

        if (depth > FractalLimits.Depth.Value)
        {
            throw Error(depthStart, $"the depth is more than the limit of {FractalLimits.Depth.Value}", isLimitExceeded: true);
        }

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

    private void RequireFinite(Cursor cursor, string name, DeclaredObject value)
    {
        if (value.Steps.LevelCount is null)
        {
            throw Error(cursor, $"the base '{name}' is infinite: give it a depth");
        }
    }

    private void RequireStepLimits(DeclaredSteps steps, Cursor cursor)
    {
        if (steps.Count > FractalLimits.Steps.Value || steps.NestingDepth > FractalLimits.Nesting.Value)
        {
            var limits = $"{FractalLimits.Steps.Value} steps, or of {FractalLimits.Nesting.Value} recursives inside each other";
            throw Error(cursor, $"the object has more than the limit of {limits}", isLimitExceeded: true);
        }
    }
}
