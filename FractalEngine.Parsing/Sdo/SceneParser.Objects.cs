using FractalEngine.Core.Colliders;
using FractalEngine.Core.Scenes;
using FractalEngine.Parsing.Text;

namespace FractalEngine.Parsing.Sdo;

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
            || !ParseOptionalSeparator(rest, out rest) || !ParseNumber(rest, static number => number is >= 0 and <= 1,
                "the coefficient of restitution must lie between 0 and 1", out var restitution, out rest))
        {
            return false;
        }

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
            return ParseString(rest, "a name in quotes", out var name, out rest) && Set(ref declared, declared with { Name = name });
        }

        if (ParseKeyword(cursor, "colour", out rest) || ParseKeyword(cursor, "color", out rest))
        {
            return ParseColour(rest, out var colour, out rest) && Set(ref declared, declared with { Colour = colour });
        }

        if (ParseKeyword(cursor, "gradient", out rest))
        {
            return ParseGradient(rest, out var gradient, out rest) && Set(ref declared, declared with { Gradient = gradient });
        }

        if (declared is PhysicsObject body)
        {
            RequireNone(ObjectOptions, cursor, "objects that no force moves, which an 'o' line declares");
            return ParseBodyOption(cursor, ref body, out rest) && Set(ref declared, body);
        }

        if (ParseKeyword(cursor, "moving", out rest))
        {
            return ParseMotion(rest, declared.Placement.Position, out var motion, out rest)
                && Set(ref declared, declared with { Motion = motion });
        }

        if (ParseKeyword(cursor, "belt", out rest))
        {
            return ParseVector(rest, out var belt, out rest) && Set(ref declared, declared with { Belt = belt });
        }

        RequireNone(BodyOptions, cursor, "physics objects, which a 'p' line declares");
        return false;
    }

    private static bool Set<T>(ref T declared, T changed)
    {
        declared = changed;
        return true;
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

        return ParseColour(rest, out var colour, out rest) && Set(ref gradient, new(kind, colour));
    }

    private bool ParseBodyOption(Cursor start, ref PhysicsObject body, out Cursor rest)
    {
        if (ParseKeyword(start, "velocity", out rest))
        {
            return ParseVector(rest, out var velocity, out rest) && Set(ref body, body with { Velocity = velocity });
        }

        if (ParseKeyword(start, "mass", out rest))
        {
            return ParseNumber(rest, static mass => mass > 0, "the mass must be positive", out var mass, out rest)
                && Set(ref body, body with { Mass = mass });
        }

        foreach (var (keyword, quantity, withNumber) in NonNegativeBodyNumbers)
        {
            if (ParseKeyword(start, keyword, out rest))
            {
                return ParseNonNegative(rest, quantity, out var number, out rest) && Set(ref body, withNumber(body, number));
            }
        }

        if (ParseKeyword(start, "inertia", out rest))
        {
            const string fault = "the inertia must be positive and at most 2/3";
            return ParseNumber(rest, static value => value is > 0 and <= PhysicsObject.ShellInertiaFactor, fault, out var factor, out rest)
                && Set(ref body, body with { InertiaFactor = factor });
        }

        if (ParseKeyword(start, "shape", out rest))
        {
            return ParseShape(rest, out var shape, out rest) && Set(ref body, body with { Shape = shape });
        }

        if (ParseKeyword(start, "rotation", out rest))
        {
            return ParseWord(rest, "locked", out rest) && Set(ref body, body with { IsRotationLocked = true });
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
                return Set(ref body, body with { Collider = kind });
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
            return ParseNumber(
                    rest, static number => number is >= 1 and <= BodyShape.MaxBallCount && number == Math.Floor(number),
                    $"a body has 1 to {BodyShape.MaxBallCount} balls", out var count, out rest)
                && Set(ref shape, BodyShape.Balls((int)count));
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

    private bool ParseNonNegative(Cursor cursor, string quantity, out double number, out Cursor rest) =>
        ParseNumber(cursor, static number => number >= 0, $"{quantity} must not be negative", out number, out rest);
}
