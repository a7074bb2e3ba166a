using FractalEngine.Core.Scenes;
using FractalEngine.Parsing.Assets;
using FractalEngine.Parsing.Text;

namespace FractalEngine.Parsing.Scenes;

/// <content>Parses objects and the options that follow them.</content>
public sealed partial class SceneParser
{
    // With the blank that follows each.
    private static readonly string[] BodyOptions =
    [
        "velocity ", "mass ", "friction ", "damping ", "rolling ", "spinning ", "inertia ", "shape ", "rotation ", "shrink ", "collider ",
    ];

    private static readonly (string Keyword, string Quantity, Func<PhysicsObject, double, PhysicsObject> With)[] NonNegativeBodyNumbers =
    [
        ("friction", "the friction", static (body, number) => body with { Friction = number }),
        ("damping", "the damping", static (body, number) => body with { Damping = number }),
        ("rolling", "the rolling friction", static (body, number) => body with { RollingFriction = number }),
        ("spinning", "the spinning friction", static (body, number) => body with { SpinningFriction = number }),
    ];

    private static readonly string[] ObjectOptions = ["moving ", "belt "];

    private delegate bool OptionParser<T>(Cursor cursor, ref T declared, out Cursor rest);

    private bool ParseObject(Cursor cursor, out Cursor rest)
    {
        if (!ParseFileName(cursor, out var file, out rest) || !ParseMatrix(rest, out var placement, out rest))
        {
            return false;
        }

        _objects.Add(ParseOptions(rest, new SceneObject(file, placement), ParseObjectOption, out rest));
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
        _objects.Add(ParseOptions<SceneObject>(rest, new PhysicsObject(file, placement, restitution), ParseObjectOption, out rest));
        return true;
    }

    /// <summary>Parses a file name in quotes, whose ending tells what the file holds.</summary>
    private bool ParseFileName(Cursor cursor, out string file, out Cursor rest)
    {
        if (!ParseString(cursor, "a file name in quotes", out file, out rest))
        {
            return false;
        }

        _fileNameOffset = cursor.Offset;
        if (!_fileNames.TryGetValue(file, out var known))
        {
            Require(FileKinds.FromName(file) is FileKind.Mesh or FileKind.Fractal, cursor,
                $"expected the name of a mesh or fractal ({FileKinds.MeshEndings}, .fdo)");
            _fileNames.Add(file, file);
        }

        file = known ?? file;
        return ParseOptionalSeparator(rest, out rest);
    }

    /// <summary>Parses all options that follow a declaration; there may be none.</summary>
    /// <param name="cursor">Position behind the declaration.</param>
    /// <param name="declared">The declaration without options.</param>
    /// <param name="parseOption">Parses one option; fails without advancing if there is none.</param>
    /// <param name="rest">Position behind the last option.</param>
    /// <returns>The declaration with its options.</returns>
    /// <exception cref="SourceException">An option has a faulty value.</exception>
    private T ParseOptions<T>(Cursor cursor, T declared, OptionParser<T> parseOption, out Cursor rest)
    {
        rest = cursor;
        while (ParseBlankOrEndOfLine(rest, out var start))
        {
            if (!parseOption(start, ref declared, out var next))
            {
                return next.Offset > start.Offset ? throw SyntaxError() : declared;
            }

            rest = next;
        }

        return declared;
    }

    private bool ParseObjectOption(Cursor cursor, ref SceneObject declared, out Cursor rest)
    {
        if (ParseKeyword(cursor, "name", out rest))
        {
            var success = ParseString(rest, "a name in quotes", out var name, out rest);
            declared = declared with { Name = name };
            return success;
        }

        if (ParseKeyword(cursor, "colour", out rest) || ParseKeyword(cursor, "color", out rest))
        {
            var success = ParseColour(rest, out var colour, out rest);
            declared = declared with { Colour = colour };
            return success;
        }

        if (ParseKeyword(cursor, "gradient", out rest))
        {
            var success = ParseGradient(rest, out var gradient, out rest);
            declared = declared with { Gradient = gradient };
            return success;
        }

        if (declared is PhysicsObject body)
        {
            RequireNone(ObjectOptions, cursor, "objects that no force moves, which an 'o' line declares");

            var success = ParseBodyOption(cursor, ref body, out rest);
            declared = body;
            return success;
        }

        if (ParseKeyword(cursor, "moving", out rest))
        {
            var success = ParseMotion(rest, declared.Placement.Position, out var motion, out rest);
            declared = declared with { Motion = motion };
            return success;
        }

        if (ParseKeyword(cursor, "belt", out rest))
        {
            var success = ParseVector(rest, out var belt, out rest);
            declared = declared with { Belt = belt };
            return success;
        }

        RequireNone(BodyOptions, cursor, "physics objects, which a 'p' line declares");
        return false;
    }

    /// <summary>Rejects options of other objects.</summary>
    private void RequireNone(string[] options, Cursor cursor, string owners)
    {
        // The message is made at a fault only: scenes have a hundred thousand objects.
        foreach (var option in options)
        {
            if (cursor.Rest.StartsWith(option, StringComparison.Ordinal))
            {
                throw Error(cursor, $"unexpected '{option.TrimEnd()}': it is an option of {owners}");
            }
        }
    }

    /// <summary>Parses the blank before an option, which may be missing at the end of the line.</summary>
    private bool ParseBlankOrEndOfLine(Cursor cursor, out Cursor rest) =>
        ParseBlanks(cursor, out rest) && (rest.Offset > cursor.Offset || IsAtEndOfLine(rest) || Fail(rest, "a blank"));

    private bool ParseGradient(Cursor cursor, out Gradient gradient, out Cursor rest)
    {
        var kind = ParseKeyword(cursor, "level", out rest) ? GradientKind.Level
            : ParseKeyword(cursor, "path", out rest) ? GradientKind.Path
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

        foreach (var (keyword, quantity, withNumber) in NonNegativeBodyNumbers)
        {
            if (ParseKeyword(start, keyword, out rest))
            {
                var success = ParseNonNegative(rest, quantity, out var number, out rest);
                body = withNumber(body, number);
                return success;
            }
        }

        if (ParseKeyword(start, "inertia", out rest))
        {
            var valueStart = rest;
            var success = ParseNumber(valueStart, out var inertia, out rest);
            var isInRange = inertia is > 0 and <= PhysicsObject.ShellInertiaFactor;
            Require(!success || isInRange, valueStart, "the inertia must be positive and at most 2/3");
            body = body with { InertiaFactor = inertia };
            return success;
        }

        if (ParseKeyword(start, "shape", out rest))
        {
            var success = ParseShape(rest, out var shape, out rest);
            body = body with { Shape = shape };
            return success;
        }

        if (ParseKeyword(start, "rotation", out rest))
        {
            body = body with { IsRotationLocked = true };
            return ParseWord(rest, "locked", out rest);
        }

        if (ParseKeyword(start, "shrink", out rest))
        {
            return ParseShrinkage(rest, ref body, out rest);
        }

        return ParseKeyword(start, "collider", out rest) && ParseCollider(rest, ref body, out rest);
    }

    private bool ParseCollider(Cursor cursor, ref PhysicsObject body, out Cursor rest)
    {
        foreach (var (kind, name) in ColliderNames.All)
        {
            if (ParseWord(cursor, name, out rest))
            {
                body = body with { Collider = kind };
                return true;
            }
        }

        rest = cursor;
        return false;
    }

    /// <summary>Parses what of a body collides: a number of balls or a capsule.</summary>
    private bool ParseShape(Cursor cursor, out BodyShape shape, out Cursor rest)
    {
        shape = BodyShape.Ball;
        if (ParseKeyword(cursor, "balls", out rest))
        {
            var countStart = rest;
            var success = ParseNumber(countStart, out var count, out rest);
            Require(
                !success || (count is >= 1 and <= BodyShape.MaxBallCount && count == Math.Floor(count)), countStart,
                $"a body has 1 to {BodyShape.MaxBallCount} balls");
            shape = success ? BodyShape.Balls((int)count) : shape;
            return success;
        }

        shape = BodyShape.Capsule;
        return ParseWord(cursor, "capsule", out rest);
    }

    /// <summary>Parses a rate and an optional scale at which shrinking ends.</summary>
    private bool ParseShrinkage(Cursor cursor, ref PhysicsObject body, out Cursor rest)
    {
        var success = ParseNonNegative(cursor, "the rate of shrinking", out var rate, out rest);
        var minimum = PhysicsObject.DefaultMinScale;
        // Anything but a number begins the next option.
        if (success && ParseSeparator(rest, out var minimumStart) && ParseNumber(minimumStart, out var statedMinimum, out var minimumEnd))
        {
            Require(statedMinimum is > 0 and <= 1, minimumStart, "the smallest scale must be more than 0 and no more than 1");
            minimum = statedMinimum;
            rest = minimumEnd;
        }

        body = body with { Shrinkage = rate, MinScale = minimum };
        return success;
    }

    private bool ParseNonNegative(Cursor cursor, string quantity, out double number, out Cursor rest)
    {
        var success = ParseNumber(cursor, out number, out rest);
        Require(!success || number >= 0, cursor, $"{quantity} must not be negative");
        return success;
    }
}
