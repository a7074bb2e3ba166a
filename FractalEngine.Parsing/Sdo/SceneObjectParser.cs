using FractalEngine.Core.Colliders;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Parsing.Text;

namespace FractalEngine.Parsing.Sdo;

/// <summary>Parses the objects of scene files, with the options that follow them.</summary>
public abstract class SceneObjectParser : LightParser
{
    private readonly Option<SceneObject>[] _objectOptions;
    private readonly Option<SceneObject>[] _bodyOptions;

    // One string for each name, however many objects have it.
    private readonly Dictionary<string, string> _fileNames = [];

    private protected SceneObjectParser(SourceText source)
        : base(source)
    {
        Option<SceneObject>[] common =
        [
            Option<SceneObject>.Of<string>("name", ParseObjectName, (declared, name) => declared with { Name = name }),
            Option<SceneObject>.Of<Colour>("colour", ParseColour, (declared, colour) => declared with { Colour = colour }),
            Option<SceneObject>.Of<Colour>("color", ParseColour, (declared, colour) => declared with { Colour = colour }),
            Option<SceneObject>.Of<Gradient>("gradient", ParseGradedSurface, (declared, gradient) => declared with { Gradient = gradient }),
        ];
        Option<SceneObject>[] moving =
        [
            new("moving", ParseMotion),
            Option<SceneObject>.Of<Vector>("belt", ParseVector, (declared, belt) => declared with { Belt = belt }),
        ];
        Option<SceneObject>[] bodies =
        [
            BodyOption<Vector>("velocity", ParseVector, (body, velocity) => body with { Velocity = velocity }),
            BodyOption("mass", Number(mass => mass > 0, "the mass must be positive"), (body, mass) => body with { Mass = mass }),
            BodyOption(
                "density", Number(density => density > 0, "the density must be positive"),
                (body, density) => body with { Density = density }),
            BodyOption("friction", NonNegative("the friction"), (body, friction) => body with { Friction = friction }),
            BodyOption("damping", NonNegative("the damping"), (body, damping) => body with { Damping = damping }),
            BodyOption("rolling", NonNegative("the rolling friction"), (body, friction) => body with { RollingFriction = friction }),
            BodyOption("spinning", NonNegative("the spinning friction"), (body, friction) => body with { SpinningFriction = friction }),
            BodyOption<double>("inertia", ParseInertia, (body, factor) => body with { InertiaFactor = factor }),
            BodyOption<BodyShape>("shape", ParseShape, (body, shape) => body with { Shape = shape }),
            BodyOption<bool>("rotation", ParseLock, (body, isLocked) => body with { IsRotationLocked = isLocked }),
            BodyOption<(double Rate, double Minimum)>(
                "shrink", ParseShrinkage, (body, shrinkage) => body with { Shrinkage = shrinkage.Rate, MinScale = shrinkage.Minimum }),
            BodyOption<ColliderKind>("collider", ParseCollider, (body, collider) => body with { Collider = collider }),
        ];
        _objectOptions = [.. common, .. moving, .. OptionsOf("physics objects, which a 'p' line declares", bodies)];
        _bodyOptions = [.. common, .. bodies, .. OptionsOf("objects that no force moves, which an 'o' line declares", moving)];
    }

    /// <summary>All objects that were declared so far.</summary>
    private protected List<SceneObject> Objects { get; } = [];

    private static Option<SceneObject> BodyOption<T>(
        string keyword, ItemParser<T> parse, Func<PhysicsObject, T, PhysicsObject> with) =>
        Option<SceneObject>.Of<T>(keyword, parse, (declared, value) => with((PhysicsObject)declared, value));

    private static IEnumerable<Option<SceneObject>> OptionsOf(string owners, Option<SceneObject>[] options) =>
        options.Select(option => option with { Owners = owners });

    /// <summary>Parses an object behind its <c>o</c>.</summary>
    private protected bool ParseObject(Cursor cursor, out Cursor rest)
    {
        if (!ParseFileName(cursor, out var file, out rest) || !ParseMatrix(rest, out var placement, out rest))
        {
            return false;
        }

        Objects.Add(ParseOptions(rest, new(file, placement), _objectOptions, out rest));
        return true;
    }

    /// <summary>Parses a physics object behind its <c>p</c>.</summary>
    private protected bool ParsePhysicsObject(Cursor cursor, out Cursor rest)
    {
        if (!ParseFileName(cursor, out var file, out rest) || !ParseMatrix(rest, out var placement, out rest)
            || !ParseOptionalSeparator(rest, out rest) || !ParseNumber(rest, static number => number is >= 0 and <= 1,
                "the coefficient of restitution must lie between 0 and 1", out var restitution, out rest))
        {
            return false;
        }

        Objects.Add(ParseOptions(rest, new PhysicsObject(file, placement, restitution), _bodyOptions, out rest));
        return true;
    }

    /// <summary>Parses a file name in quotes, whose ending tells what the file holds.</summary>
    private bool ParseFileName(Cursor cursor, out string file, out Cursor rest)
    {
        if (!ParseString(cursor, "a file name in quotes", out file, out rest))
        {
            return false;
        }

        FileNameOffset = cursor.Offset;
        if (!_fileNames.TryGetValue(file, out var known))
        {
            Require(FileKinds.FromName(file) is FileKind.Mesh or FileKind.Fractal, cursor,
                $"expected the name of a mesh or fractal ({FileKinds.MeshEndings}, .fdo)");
            _fileNames.Add(file, file);
        }

        file = known ?? file;
        return ParseOptionalSeparator(rest, out rest);
    }

    private bool ParseObjectName(Cursor cursor, out string name, out Cursor rest) =>
        ParseString(cursor, "a name in quotes", out name, out rest);

    /// <summary>Parses how an object moves by itself: <c>velocity (…) spin (…) from (…) to (…)</c>.</summary>
    private bool ParseMotion(Cursor cursor, ref SceneObject declared, out Cursor rest)
    {
        var (velocity, spin) = (Vector.Zero, Vector.Zero);
        var hasVelocity = ParseKeyword(cursor, "velocity", out var velocityStart);
        rest = cursor;
        if (hasVelocity && !ParseVector(velocityStart, out velocity, out rest))
        {
            return false;
        }

        var hasSpin = ParseNextKeyword(rest, "spin", hasVelocity, out var spinStart);
        if ((hasSpin && !ParseVector(spinStart, out spin, out rest)) || !(hasVelocity || hasSpin))
        {
            return false;
        }

        var motion = new ObjectMotion { Velocity = velocity, Spin = spin };
        return (!hasVelocity || !ParseNextKeyword(rest, "from", true, out var fromStart)
                || ParsePath(fromStart, velocityStart, declared.Placement.Position, ref motion, out rest))
            && Set(ref declared, declared with { Motion = motion });
    }

    private bool ParsePath(Cursor cursor, Cursor velocityStart, Vector start, ref ObjectMotion motion, out Cursor rest)
    {
        if (!ParseVector(cursor, out var from, out rest) || !ParseBlanks(rest, out rest)
            || !ParseKeyword(rest, "to", out rest) || !ParseVector(rest, out var to, out rest))
        {
            return false;
        }

        motion = motion with { From = from, To = to };
        var fault = motion.FindFault(start);
        var isAboutVelocity = (motion with { Velocity = Vector.Zero }).FindFault(start) is null;
        Require(fault is null, isAboutVelocity ? velocityStart : cursor, fault ?? "");
        Require(motion.Velocity != Vector.Zero, velocityStart, "the velocity along a path must not be (0, 0, 0)");
        return true;
    }

    private bool ParseCollider(Cursor cursor, out ColliderKind collider, out Cursor rest) =>
        ParseChoice(cursor, ColliderNames.All.AsSpan(), out collider, out rest);

    private bool ParseLock(Cursor cursor, out bool isLocked, out Cursor rest) => isLocked = ParseWord(cursor, "locked", out rest);

    private bool ParseInertia(Cursor cursor, out double factor, out Cursor rest) => ParseNumber(
        cursor, static factor => factor is > 0 and <= PhysicsObject.ShellInertiaFactor, "the inertia must be positive and at most 2/3",
        out factor, out rest);

    /// <summary>Parses what of a body collides: a number of balls, a capsule or the model itself.</summary>
    private bool ParseShape(Cursor cursor, out BodyShape shape, out Cursor rest)
    {
        if (!ParseKeyword(cursor, "balls", out rest))
        {
            shape = ParseWord(cursor, "mesh", out rest) ? BodyShape.Mesh : BodyShape.Capsule;
            return shape.IsMesh || ParseWord(cursor, "capsule", out rest);
        }

        shape = default;
        return ParseNumber(
                rest, static number => number is >= 1 and <= BodyShape.MaxBallCount && number == Math.Floor(number),
                $"a body has 1 to {BodyShape.MaxBallCount} balls", out var count, out rest)
            && Set(ref shape, BodyShape.Balls((int)count));
    }

    /// <summary>Parses a rate and an optional scale at which shrinking ends.</summary>
    private bool ParseShrinkage(Cursor cursor, out (double Rate, double Minimum) shrinkage, out Cursor rest)
    {
        var isParsed = ParseNonNegative(cursor, "the rate of shrinking", out var rate, out rest);
        shrinkage = (rate, PhysicsObject.DefaultMinScale);
        // Anything but a number begins the next option.
        if (isParsed && ParseSeparator(rest, out var minimumStart) && ParseNumber(minimumStart, out var minimum, out var minimumEnd))
        {
            Require(minimum is > 0 and <= 1, minimumStart, "the smallest scale must be more than 0 and no more than 1");
            shrinkage.Minimum = minimum;
            rest = minimumEnd;
        }

        return isParsed;
    }
}
