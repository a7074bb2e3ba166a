using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Parsing.Text;
using FractalEngine.Parsing.Text.Grammar;

namespace FractalEngine.Parsing.Fdo;

/// <content>Parses objects: base meshes, sets applied to objects, and recursives to a depth.</content>
public sealed partial class FractalParser
{
    /// <summary>Parses a named object: <c>name. object</c>.</summary>
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
            value = FindObject(cursor, name);
            return true;
        }

        if (depthStart.Current == '-' && char.IsAsciiDigit(depthStart.Peek(1)))
        {
            throw Error(depthStart, "the depth of a recursive must not be negative");
        }

        if (depthStart.Offset == rest.Offset || !ParseInteger(depthStart, "a depth", out var depth, out rest))
        {
            return Fail(depthStart, SyntaxFailure.EndOfLine);
        }

        if (FindObject(cursor, name) is not DeclaredRecursive recursive)
        {
            throw Error(depthStart, $"'{name}' is no recursive, so it has no depth");
        }

        if (depth > FractalLimits.MaxDepth)
        {
            throw Error(depthStart, $"the depth is more than the limit of {FractalLimits.MaxDepth}", isLimitExceeded: true);
        }

        value = recursive.WithDepth(depth);
        ListDepth(name, depthStart, rest, depth);
        return true;
    }
}
