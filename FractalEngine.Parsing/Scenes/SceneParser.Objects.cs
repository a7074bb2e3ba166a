using FractalEngine.Core.Scenes;
using FractalEngine.Parsing.Text;

namespace FractalEngine.Parsing.Scenes;

/// <content>Objects and what may stand behind them.</content>
public sealed partial class SceneParser
{
    private static readonly string[] ColliderNames = ["exact", "fractal", "hierarchy", "bounding-box", "simple"];

    /// <summary>The name by which scene files and the command line call a collider.</summary>
    public static string GetColliderName(ColliderKind collider) => ColliderNames[(int)collider];

    private bool ParseObject(Cursor cursor, out Cursor rest)
    {
        if (!ParseFileName(cursor, out var file, out rest) || !ParseMatrix(rest, out var placement, out rest))
        {
            return false;
        }

        var declared = new SceneObject(file, placement);
        while (ParseObjectOption(rest, ref declared, out rest))
        {
        }

        _objects.Add(declared);
        return true;
    }

    private bool ParsePhysicsObject(Cursor cursor, out Cursor rest)
    {
        if (!ParseFileName(cursor, out var file, out rest) || !ParseMatrix(rest, out var placement, out rest)
            || !ParseOptionalSeparator(rest, out var restitutionStart) || !ParseNumber(restitutionStart, out var restitution, out rest))
        {
            return false;
        }

        Require(restitution is >= 0 and <= 1, restitutionStart, "the coefficient of restitution must lie between 0 and 1");
        SceneObject declared = new PhysicsObject(file, placement, restitution);
        while (ParseObjectOption(rest, ref declared, out rest))
        {
        }

        _objects.Add(declared);
        return true;
    }

    /// <summary>A file name in quotes; its ending says what the file holds.</summary>
    private bool ParseFileName(Cursor cursor, out string file, out Cursor rest)
    {
        if (!ParseString(cursor, "a file name in quotes", out file, out rest))
        {
            return false;
        }

        Require(
            file.EndsWith(".obj", StringComparison.OrdinalIgnoreCase) || file.EndsWith(".fdo", StringComparison.OrdinalIgnoreCase),
            cursor, "expected the name of a .obj or .fdo file");
        _fileNameOffset = cursor.Offset;
        return ParseOptionalSeparator(rest, out rest);
    }

    /// <summary>One of the trailing parts of an object; false, and the cursor unmoved, when there is none.</summary>
    private bool ParseObjectOption(Cursor cursor, ref SceneObject declared, out Cursor rest)
    {
        rest = cursor;
        if (!ParseBlankOrEndOfLine(cursor, out var start))
        {
            return false;
        }

        var (success, next) = (false, start);
        if (ParseKeyword(start, "name", out next))
        {
            success = ParseString(next, "a name in quotes", out var name, out next);
            declared = declared with { Name = name };
        }
        else if (ParseKeyword(start, "colour", out next) || ParseKeyword(start, "color", out next))
        {
            success = ParseColour(next, out var colour, out next);
            declared = declared with { Colour = colour };
        }
        else if (ParseKeyword(start, "gradient", out next))
        {
            success = ParseGradient(next, out var gradient, out next);
            declared = declared with { Gradient = gradient };
        }
        else if (declared is PhysicsObject body)
        {
            success = ParseBodyOption(start, ref body, out next);
            declared = body;
        }

        rest = success ? next : next.Offset > start.Offset ? throw SyntaxError() : cursor;
        return success;
    }

    /// <summary>What stands before a trailing part: a blank, unless the line ends there.</summary>
    private bool ParseBlankOrEndOfLine(Cursor cursor, out Cursor rest) =>
        ParseBlanks(cursor, out rest) && (rest.Offset > cursor.Offset || IsAtEndOfLine(rest) || Fail(rest, "a blank"));

    private bool ParseGradient(Cursor cursor, out Gradient gradient, out Cursor rest)
    {
        var kind = ParseKeyword(cursor, "level", out rest) ? GradientKind.Level : ParseKeyword(cursor, "path", out rest)
            ? GradientKind.Path
            : GradientKind.None;
        gradient = new(kind, default);
        if (kind == GradientKind.None)
        {
            return false;
        }

        var success = ParseColour(rest, out var colour, out rest);
        gradient = gradient with { EndColour = colour };
        return success;
    }

    private bool ParseBodyOption(Cursor start, ref PhysicsObject body, out Cursor rest)
    {
        if (ParseKeyword(start, "velocity", out rest))
        {
            var success = ParseVector(rest, out var velocity, out rest);
            body = body with { Velocity = velocity };
            return success;
        }

        if (ParseKeyword(start, "mass", out rest))
        {
            var valueStart = rest;
            var success = ParseNumber(valueStart, out var mass, out rest);
            Require(!success || mass > 0, valueStart, "the mass must be positive");
            body = body with { Mass = mass };
            return success;
        }

        if (ParseKeyword(start, "friction", out rest))
        {
            var success = ParseNonNegative(rest, "the friction", out var friction, out rest);
            body = body with { Friction = friction };
            return success;
        }

        if (ParseKeyword(start, "damping", out rest))
        {
            var success = ParseNonNegative(rest, "the damping", out var damping, out rest);
            body = body with { Damping = damping };
            return success;
        }

        if (ParseKeyword(start, "shrink", out rest))
        {
            return ParseShrinkage(rest, ref body, out rest);
        }

        if (ParseKeyword(start, "collider", out rest))
        {
            var valueStart = rest;
            for (var kind = 0; kind < ColliderNames.Length; kind++)
            {
                if (ParseWord(valueStart, ColliderNames[kind], out rest))
                {
                    body = body with { Collider = (ColliderKind)kind };
                    return true;
                }
            }
        }

        return false;
    }

    /// <summary>A rate, and the scale at which shrinking ends where one is written.</summary>
    private bool ParseShrinkage(Cursor cursor, ref PhysicsObject body, out Cursor rest)
    {
        var success = ParseNonNegative(cursor, "the rate of shrinking", out var rate, out rest);
        var minimum = PhysicsObject.DefaultMinimumScale;
        // What is no number begins the next option.
        if (success && ParseSeparator(rest, out var minimumStart) && ParseNumber(minimumStart, out var statedMinimum, out var minimumEnd))
        {
            Require(statedMinimum is > 0 and <= 1, minimumStart, "the smallest scale must be more than 0 and no more than 1");
            (minimum, rest) = (statedMinimum, minimumEnd);
        }

        body = body with { Shrinkage = rate, MinimumScale = minimum };
        return success;
    }

    private bool ParseNonNegative(Cursor cursor, string quantity, out double number, out Cursor rest)
    {
        var success = ParseNumber(cursor, out number, out rest);
        Require(!success || number >= 0, cursor, $"{quantity} must not be negative");
        return success;
    }
}
