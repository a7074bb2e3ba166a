using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Maths;
using FractalEngine.Parsing.Text;
using FractalEngine.Parsing.Text.Grammar;

namespace FractalEngine.Parsing.Fdo;

/// <summary>
/// Reads fractal files (paper §4.2.2): vectors, transformation functions, objects and recursives, and the one result marked by
/// <c>&lt;$&gt;</c>. The grammar is in docs/manual.md. Nothing is expanded, so the result is as small as the file.
/// </summary>
public sealed partial class FractalParser : Parser
{
    private static readonly DeclaredObject EmptyObject = new("", 0, DeclaredSteps.None);

    private readonly List<Vector> _vectors = [];
    private readonly Dictionary<string, TransformationFunction> _functions = [];
    private readonly Dictionary<string, DeclaredObject> _objects = [];

    // Where the name of an object or of a transformation is declared; keys of the latter end with a dot. A key with a blank is no name.
    private readonly Dictionary<string, int> _declarationOffsets = [];
    private Composition? _composition;
    private (DeclaredObject Object, int Offset)? _result;
    private bool _hasDeclaration;
    private long _mapCount;
    private long _repeatedStepCount;

    private protected override string? Explain(SyntaxFailure failure) => FractalMistakes.Explain(failure);

    private FractalParser(SourceText source)
        : base(source)
    {
    }

    /// <summary>Parses a whole fractal file. The file of the base mesh is not read.</summary>
    /// <exception cref="SourceException">The text is not a fractal, or has no valid meaning.</exception>
    public static ParsedFractal Parse(SourceText source) => new FractalParser(source).ParseFile();

    private ParsedFractal ParseFile()
    {
        for (var cursor = Source.Start; !cursor.IsAtEnd;)
        {
            if (!ParseLine(cursor, out cursor))
            {
                throw SyntaxError();
            }
        }

        if (_functions.Values.FirstOrDefault(function => function.Last.VectorNumber > _vectors.Count) is { } uncalled)
        {
            throw VectorError(uncalled.Last.Start, "");
        }

        if (_result is not { } result)
        {
            throw _hasDeclaration
                ? Source.Error(Source.Text.TrimEnd().Length, "the fractal has no result: expected a declaration '<$>. object'")
                : Source.Error(0, "the fractal declares nothing");
        }

        var description = new FractalDescription(result.Object.Steps.Take(result.Object.Steps.Count), _composition ?? Composition.Affine);
        if (!FractalCheck.IsComposable(description))
        {
            throw Source.Error(result.Offset, FractalCheck.NotComposableMessage);
        }

        return new(Source, description, result.Object.BaseFile, result.Object.BaseFileNameOffset, result.Offset) { Warnings = Hints };
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
            || ParseFunction(cursor, out rest)
            || ParseRecursive(cursor, out rest)
            || ParseObjectDeclaration(cursor, out rest);
    }

    /// <summary>Parses a vector: <c>v x y z</c>.</summary>
    private bool ParseVectorDeclaration(Cursor cursor, out Cursor rest)
    {
        if (!ParseWord(cursor, "v", out rest) || !ParseBlanks(rest, out var numbers) || numbers.Offset == rest.Offset
            || !ParseComponents(numbers, out var vector, out rest))
        {
            return false;
        }

        _vectors.Add(vector);
        ListVector(numbers, rest);
        return true;
    }

    /// <summary>Parses the choice <c>composition affine</c> or <c>composition componentwise</c>.</summary>
    private bool ParseComposition(Cursor cursor, out Cursor rest)
    {
        if (!ParseWord(cursor, "composition", out rest) || !ParseBlanks(rest, out var word) || word.Offset == rest.Offset
            || !ParseCompositionName(word, out var composition, out rest))
        {
            return false;
        }

        if (_composition is not null)
        {
            throw Error(cursor, $"the composition is declared twice, first in line {LineOfDeclaration("composition ")}");
        }

        _composition = composition;
        _declarationOffsets["composition "] = cursor.Offset;
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

        RequireLevelLimit(value.Steps.LevelCount, cursor);
        RequireDigitLimit(value.Steps, cursor);
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

        var baseObject = FindObject(baseStart, baseName);
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

        RequireLevelLimit(body.Steps.LevelCount - baseObject.Steps.LevelCount, bodyStart);
        RequireLimit(_repeatedStepCount += stepCount, ParsingLimits.MaxRepeatedSteps, "steps in all recursives", bodyStart);
        DeclareObject(cursor, name, new DeclaredRecursive(baseObject, body.Steps.Take(stepCount)));
        return true;
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
        if (steps.Count > FractalLimits.MaxSteps || steps.NestingDepth > FractalLimits.MaxNesting)
        {
            var limits = $"{FractalLimits.MaxSteps} steps, or of {FractalLimits.MaxNesting} recursives inside each other";
            throw Error(cursor, $"the object has more than the limit of {limits}", isLimitExceeded: true);
        }
    }

    private void RequireLevelLimit(long? levelCount, Cursor cursor)
    {
        if (levelCount > FractalLimits.MaxLevels)
        {
            throw Error(cursor, $"the fractal has more than the limit of {FractalLimits.MaxLevels} levels", isLimitExceeded: true);
        }
    }

    private void RequireDigitLimit(DeclaredSteps steps, Cursor cursor)
    {
        if (FractalSteps.EstimateDigits(steps.Take(steps.Count)) > FractalLimits.MaxDigits)
        {
            throw Error(
                cursor, $"the number of instances has more than the limit of {FractalLimits.MaxDigits} digits", isLimitExceeded: true);
        }
    }

    private void RequireLimit(long count, long limit, string countedThings, Cursor cursor)
    {
        if (count > limit)
        {
            throw Error(cursor, $"the file has more than the limit of {limit} {countedThings}", isLimitExceeded: true);
        }
    }

    private int LineOfDeclaration(string key) => Source.LineOf(_declarationOffsets[key]);

    private void DeclareObject(Cursor cursor, string name, DeclaredObject value)
    {
        RequireLimit(_objects.Count + _functions.Count + 1, ParsingLimits.MaxNames, "names", cursor);
        if (!_objects.TryAdd(name, value))
        {
            throw Error(cursor, $"the object '{name}' is declared twice, first in line {LineOfDeclaration(name)}");
        }

        _declarationOffsets[name] = cursor.Offset;
    }
}
