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
    private static readonly DeclaredObject Nothing = new("", 0, []);

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

        var description = new FractalDescription(result.Object.BaseFile, result.Object.Steps, _composition ?? Composition.Affine);
        if (description is { IsInfinite: true, Composition: Composition.Componentwise })
        {
            throw Source.Error(result.Offset, "an infinite fractal can't be composed componentwise: its positions don't shrink; give it a depth");
        }

        return new(Source, description, result.Object.BaseFileOffset, result.Offset);
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

        CheckDepth(value.Steps, cursor);
        _result = (value, cursor.Offset);
        return true;
    }

    /// <summary><c>z&lt;x&gt;. object</c>: the object must be built on x; what it adds to x is one round.</summary>
    private bool ParseRecursive(Cursor cursor, out Cursor rest)
    {
        if (!ParseName(cursor, "a declaration", out var name, out rest) || !ParseChar(rest, '<', out var basePlace)
            || !ParseName(basePlace, "the name of the base object", out var baseName, out rest) || !ParseChar(rest, '>', out rest)
            || !ParseChar(rest, '.', out rest) || !ParseBlanks(rest, out var bodyPlace) || !ParseObject(bodyPlace, out var body, out rest))
        {
            return false;
        }

        var origin = Find(basePlace, baseName);
        RequireFinite(basePlace, baseName, origin);
        if (!body.IsBuiltOn(origin))
        {
            throw Error(bodyPlace, $"the body of the recursive '{name}' is not built on its base '{baseName}'");
        }

        var round = body.Steps[..^origin.Steps.Length];
        if (round.Length == 0)
        {
            throw Error(bodyPlace, $"the recursive '{name}' adds no transformations to its base '{baseName}'");
        }

        if (round.Any(step => step.LevelCount is null))
        {
            throw Error(bodyPlace, $"the body of the recursive '{name}' is infinite: give the recursive in it a depth");
        }

        CheckDepth(round, bodyPlace);
        Declare(cursor, name, new DeclaredRecursive(origin, round));
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

        Declare(cursor, name, value);
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
                value = Nothing;
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
            value = new(value.BaseFile, value.BaseFileOffset, value.Steps.InsertRange(0, sets)) { Origin = value };
        }

        CheckSteps(value.Steps, cursor);
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
        value = Nothing;
        if (!ParseName(cursor, "the name of an object", out var name, out rest))
        {
            return false;
        }

        // The line may still turn out to be another kind of declaration, so names are looked up only once its syntax fits.
        ParseBlanks(rest, out var depthPlace);
        if (IsAtEndOfLine(depthPlace))
        {
            value = Find(cursor, name);
            return true;
        }

        if (depthPlace.Current == '-' && char.IsAsciiDigit(depthPlace.Peek(1)))
        {
            throw Error(depthPlace, "the depth of a recursive must not be negative");
        }

        if (depthPlace.Offset == rest.Offset || !ParseInteger(depthPlace, "a depth", out var depth, out rest))
        {
            return Fail(depthPlace, "the end of the line");
        }

        value = Find(cursor, name) is not DeclaredRecursive recursive ? throw Error(depthPlace, $"'{name}' is no recursive, so it has no depth")
            : depth > FractalLimits.Depth
                ? throw Error(depthPlace, $"the depth is more than the limit of {FractalLimits.Depth}", isLimit: true)
                : recursive.Flatten(depth);
        return true;
    }

    private DeclaredObject Find(Cursor place, string name) =>
        _objects.TryGetValue(name, out var value) ? value
        : throw Error(place, $"the object '{name}' is not declared above");

    private void RequireFinite(Cursor place, string name, DeclaredObject value)
    {
        if (value.Steps.Any(step => step.LevelCount is null))
        {
            throw Error(place, $"the base '{name}' is infinite: give it a depth");
        }
    }

    private void CheckSteps(ImmutableArray<FractalStep> steps, Cursor place)
    {
        if (steps.Length > FractalLimits.Steps || steps.Any(step => step.Nesting > FractalLimits.Nesting))
        {
            throw Error(
                place, $"the object has more than the limit of {FractalLimits.Steps} steps, or of {FractalLimits.Nesting} recursives inside each other", isLimit: true);
        }
    }

    private void CheckDepth(ImmutableArray<FractalStep> steps, Cursor place)
    {
        if (FractalSteps.LevelCount(steps) > FractalLimits.Levels)
        {
            throw Error(place, $"the fractal passes through more than the limit of {FractalLimits.Levels} sets of transformations", isLimit: true);
        }
    }

    private void Declare(Cursor place, string name, DeclaredObject value)
    {
        if (!_objects.TryAdd(name, value))
        {
            throw Error(place, $"the object '{name}' is declared twice");
        }
    }
}
