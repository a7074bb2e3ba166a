using System.Collections.Immutable;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Maths;
using FractalEngine.Parsing.Text;

namespace FractalEngine.Parsing.Fractals;

/// <summary>
/// Reads fractal files (paper §4.2.2): vectors, transformation functions, objects and recursives, and the one result
/// marked by <c>&lt;$&gt;</c>. The grammar stands in docs/manual.md. The result is as small as the file: nothing is expanded.
/// </summary>
public sealed partial class FractalParser : Parser
{
    private static readonly DeclaredObject EmptyObject = new("", 0, []);

    private readonly List<Vector> _vectors = [];
    private readonly Dictionary<string, TransformationFunction> _functions = [];
    private readonly Dictionary<string, DeclaredObject> _objects = [];
    private Composition? _composition;
    private (DeclaredObject Object, int Offset)? _result;
    private bool _hasDeclaration;

    private FractalParser(SourceText source)
        : base(source)
    {
    }

    /// <summary>Parses a whole file. The base mesh's file is not touched.</summary>
    /// <exception cref="SourceException">The text is no fractal, or says something that makes no sense.</exception>
    public static FractalFile Parse(SourceText source) => new FractalParser(source).ParseFile();

    private FractalFile ParseFile()
    {
        for (var cursor = Source.Start; !cursor.IsAtEnd;)
        {
            if (!ParseLine(cursor, out cursor))
            {
                throw SyntaxError();
            }
        }

        if (_result is not { } result)
        {
            throw Error(
                _hasDeclaration ? new(Source.Text, Source.Text.TrimEnd().Length) : Source.Start,
                _hasDeclaration ? "the fractal has no result: expected a declaration '<$>. object'" : "the fractal declares nothing");
        }

        var description = new FractalDescription(result.Object.Steps, _composition ?? Composition.Affine);
        if (description is { IsInfinite: true, Composition: Composition.Componentwise })
        {
            throw Source.Error(result.Offset,
                "an infinite fractal can't be composed componentwise: its positions don't shrink; give it a depth");
        }

        return new(Source, description, result.Object.BaseFile, result.Object.BaseFileNameOffset, result.Offset);
    }

    private bool ParseLine(Cursor cursor, out Cursor rest)
    {
        ParseBlanks(cursor, out var start);
        if (start.Current == '#')
        {
            rest = SkipLine(start);
            return true;
        }

        rest = start;
        return (IsAtEndOfLine(start) || ParseDeclaration(start, out rest)) && ParseEndOfLine(rest, out rest);
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

    /// <summary><c>v x y z</c></summary>
    private bool ParseVectorDeclaration(Cursor cursor, out Cursor rest)
    {
        if (!ParseWord(cursor, "v", out rest) || !ParseBlanks(rest, out var numbers) || numbers.Offset == rest.Offset
            || !ParseComponents(numbers, out var vector, out rest))
        {
            return false;
        }

        _vectors.Add(vector);
        return true;
    }

    /// <summary><c>composition affine|componentwise</c></summary>
    private bool ParseComposition(Cursor cursor, out Cursor rest)
    {
        if (!ParseWord(cursor, "composition", out rest) || !ParseBlanks(rest, out var word) || word.Offset == rest.Offset
            || !(ParseWord(word, "affine", out rest) || ParseWord(word, "componentwise", out rest)))
        {
            return false;
        }

        if (_composition is not null)
        {
            throw Error(cursor, "the composition is declared twice");
        }

        _composition = word.Current == 'a' && word.Peek(1) == 'f' ? Composition.Affine : Composition.Componentwise;
        return true;
    }

    /// <summary><c>&lt;$&gt;. object</c></summary>
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
            throw Error(cursor, $"the result '<$>' is declared twice, first in line {Source.Diagnose(first.Offset, "").Line}");
        }

        RequireLevelLimit(value.Steps, cursor);
        _result = (value, cursor.Offset);
        return true;
    }

    /// <summary><c>z&lt;x&gt;. object</c>: the object must be built on x; what it adds to x is one round.</summary>
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

        var iterationSteps = body.Steps[..^baseObject.Steps.Length];
        if (iterationSteps.Length == 0)
        {
            throw Error(bodyStart, $"the recursive '{name}' adds no transformations to its base '{baseName}'");
        }

        if (iterationSteps.Any(step => step.LevelCount is null))
        {
            throw Error(bodyStart, $"the body of the recursive '{name}' is infinite: give the recursive in it a depth");
        }

        RequireLevelLimit(iterationSteps, bodyStart);
        DeclareObject(cursor, name, new DeclaredRecursive(baseObject, iterationSteps));
        return true;
    }

    /// <summary><c>name. object</c></summary>
    private bool ParseObjectDeclaration(Cursor cursor, out Cursor rest)
    {
        if (!ParseName(cursor, "a declaration", out var name, out rest) || !ParseChar(rest, '.', out rest)
            || !ParseBlanks(rest, out rest) || !ParseObject(rest, out var value, out rest))
        {
            return false;
        }

        DeclareObject(cursor, name, value);
        return true;
    }

    /// <summary>
    /// <c>"file.obj"</c>, <c>name</c> or <c>name depth</c>, with any number of sets <c>[transformations]</c> before it. A loop and not
    /// a recursion, so that no file can exhaust the stack.
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
            value = new(value.BaseFile, value.BaseFileNameOffset, value.Steps.InsertRange(0, sets)) { Origin = value };
        }

        RequireStepLimits(value.Steps, cursor);
        return true;
    }

    private bool ParseBaseFile(Cursor cursor, out DeclaredObject value, out Cursor rest)
    {
        var success = ParseString(cursor, "the name of a .obj file in quotes", out var file, out rest);
        value = new(file, cursor.Offset, []);
        return success && !file.EndsWith(".obj", StringComparison.OrdinalIgnoreCase)
            ? throw Error(cursor, "expected the name of a .obj file: the base of a fractal is a mesh")
            : success;
    }

    private bool ParseReference(Cursor cursor, out DeclaredObject value, out Cursor rest)
    {
        value = EmptyObject;
        if (!ParseName(cursor, "the name of an object", out var name, out rest))
        {
            return false;
        }

        // The line may still turn out to be another kind of declaration, so names are looked up only once its syntax fits.
        ParseBlanks(rest, out var depthStart);
        if (IsAtEndOfLine(depthStart))
        {
            value = FindObject(cursor, name);
            return true;
        }

        if (depthStart.Current == '-' && char.IsAsciiDigit(depthStart.Peek(1)))
        {
            throw Error(depthStart, "the depth of a recursive must not be negative");
        }

        if (depthStart.Offset == rest.Offset || !ParseInteger(depthStart, "a depth", out var depth, out rest))
        {
            return Fail(depthStart, "the end of the line");
        }

        value = FindObject(cursor, name) is not DeclaredRecursive recursive
            ? throw Error(depthStart, $"'{name}' is no recursive, so it has no depth")
            : depth > FractalLimits.MaxDepth
                ? throw Error(depthStart, $"the depth is more than the limit of {FractalLimits.MaxDepth}", isLimitExceeded: true)
                : recursive.WithDepth(depth);
        return true;
    }

    private DeclaredObject FindObject(Cursor cursor, string name) =>
        _objects.TryGetValue(name, out var value) ? value
        : throw Error(cursor, $"the object '{name}' is not declared above");

    private void RequireFinite(Cursor cursor, string name, DeclaredObject value)
    {
        if (value.Steps.Any(step => step.LevelCount is null))
        {
            throw Error(cursor, $"the base '{name}' is infinite: give it a depth");
        }
    }

    private void RequireStepLimits(ImmutableArray<FractalStep> steps, Cursor cursor)
    {
        if (steps.Length > FractalLimits.MaxSteps || steps.Any(step => step.NestingDepth > FractalLimits.MaxNesting))
        {
            throw Error(
                cursor, $"the object has more than the limit of {FractalLimits.MaxSteps} steps, or of {FractalLimits.MaxNesting} recursives inside each other", isLimitExceeded: true);
        }
    }

    private void RequireLevelLimit(ImmutableArray<FractalStep> steps, Cursor cursor)
    {
        if (FractalSteps.LevelCount(steps) > FractalLimits.MaxLevels)
        {
            throw Error(cursor, $"the fractal passes through more than the limit of {FractalLimits.MaxLevels} sets of transformations",
                isLimitExceeded: true);
        }
    }

    private void DeclareObject(Cursor cursor, string name, DeclaredObject value)
    {
        if (!_objects.TryAdd(name, value))
        {
            throw Error(cursor, $"the object '{name}' is declared twice");
        }
    }
}
