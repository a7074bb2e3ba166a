using FractalEngine.Core.Generation.Building;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Generation;

/// <summary>
/// Generates the interior of a spaceship's corridor with eight sides: ribs, panelled walls, floor plates, lights, pipes, cables, consoles
/// and a hatch at either end.
/// </summary>
/// <remarks>It replaces the paper's first model (§5.3), of which only the number of faces is known.</remarks>
internal sealed class SpaceshipInterior
{
    /// <summary>Minimum number of faces, of a corridor without details.</summary>
    public const int MinFaceCount = 16_000;

    private const int Bays = 12;
    private const double BayLength = 2;
    private const double RibWidth = 0.22;
    private const double Length = Bays * BayLength;
    private const double MaxDetail = 4096;

    /// <summary>Corners of the section, seen along z, counter-clockwise from the left end of the floor, metres.</summary>
    private static readonly (double X, double Y)[] Section =
        [(-0.95, 0), (0.95, 0), (1.6, 0.55), (1.6, 2.15), (1.05, 2.75), (-1.05, 2.75), (-1.6, 2.15), (-1.6, 0.55)];

    private readonly SplitMix64 _random;
    private readonly MeshBuilder _mesh = new();
    private readonly WallPanels _panels;
    private readonly double _detail;
    private readonly bool _isPlain;

    private SpaceshipInterior(ulong seed, double detail)
    {
        _random = new(seed);
        _detail = detail;
        _isPlain = detail < WallPanels.MinFittingDetail;
        _panels = new(_mesh, detail);
    }

    /// <summary>Sides of the section, in the order of its corners.</summary>
    private enum Side
    {
        Floor,
        RightSlope,
        RightWall,
        RightCeiling,
        Ceiling,
        LeftCeiling,
        LeftWall,
        LeftSlope,
    }

    /// <summary>Generates a corridor with an exact number of faces.</summary>
    /// <param name="seed">Seed of the panelling and the fittings.</param>
    /// <param name="faceCount">Number of faces, at least <see cref="MinFaceCount"/>.</param>
    public static Mesh Create(ulong seed, int faceCount)
    {
        // More detail means more faces, though not strictly: the search ends at the largest detail found that fits.
        var fits = 0.0;
        var tooMuch = MaxDetail;
        var best = new SpaceshipInterior(seed, 0).BuildMesh(faceCount);
        for (var step = 0; step < 24 && tooMuch - fits > 0.01 * fits; step++)
        {
            var detail = fits == 0 ? Math.Min(0.25, tooMuch / 4) : Math.Sqrt(fits * tooMuch);
            var mesh = new SpaceshipInterior(seed, detail).BuildMesh(faceCount);
            if (mesh.FaceCount <= faceCount)
            {
                fits = detail;
                best = mesh;
            }
            else
            {
                tooMuch = detail;
            }
        }

        // Halving the longest edges adds the faces that are missing.
        EdgeSplitting.SplitTo(best, faceCount);
        return best.Build();
    }

    /// <summary>Builds the corridor, or its first bays where these already have more faces than are wanted.</summary>
    private MeshBuilder BuildMesh(int maxFaces)
    {
        _mesh.BeginGroup("walls");
        for (var bay = 0; bay < Bays && _mesh.FaceCount <= maxFaces; bay++)
        {
            foreach (var side in Enum.GetValues<Side>())
            {
                AddWall(side, bay, _random.Fork((ulong)((16 * bay) + (int)side)));
            }
        }

        _mesh.BeginGroup("ribs");
        for (var rib = 0; rib <= Bays; rib++)
        {
            AddRib(rib * BayLength);
        }

        _mesh.BeginGroup("pipes");
        AddPipes(_random.Fork(1001));
        _mesh.BeginGroup("hatches");
        AddHatch(new(new(0, 1.375, 0.02), Vector.I, Vector.J));
        AddHatch(new(new(0, 1.375, Length - 0.02), -Vector.I, Vector.J));
        _mesh.BeginGroup("detail");
        return _mesh;
    }

    /// <summary>Computes the frame and the width of a side of the section at z.</summary>
    /// <remarks>The frame's right axis runs along the section, its up axis against z, and it faces the inside of the corridor.</remarks>
    private static (WallFrame Frame, double Width) Wall(Side side, double z)
    {
        var start = Section[(int)side];
        var end = Section[((int)side + 1) % Section.Length];
        var along = new Vector(end.X - start.X, end.Y - start.Y, 0);
        return (new(new(start.X, start.Y, z), along.UnitVector(), -Vector.K), along.Length());
    }

    private void AddWall(Side side, int bay, SplitMix64 random)
    {
        // The frame's up axis runs against z, so that it starts at the far end of the bay.
        var (frame, width) = Wall(side, (bay + 1) * BayLength);
        var whole = new WallArea(0, 0, width, BayLength);
        _mesh.AddWall(frame, whole);
        var area = new WallArea(0.03, (RibWidth / 2) + 0.02, width - 0.03, BayLength - (RibWidth / 2) - 0.02);
        switch (side)
        {
            case Side.Floor:
                _panels.AddFloor(frame, area);
                break;
            case Side.Ceiling:
                _panels.AddCeiling(frame, area, random);
                break;
            case Side.LeftWall or Side.RightWall when random.Chance(0.45):
                var upright = side == Side.RightWall
                    ? frame : new WallFrame(frame.At(width, BayLength), -frame.Right, -frame.Up);
                Consoles.Add(_mesh, upright, area, _detail, random);
                break;
            default:
                _panels.AddPanels(frame, area, random);
                break;
        }
    }

    private void AddRib(double z)
    {
        foreach (var side in Enum.GetValues<Side>())
        {
            var (frame, width) = Wall(side, z + (RibWidth / 2));
            var height = side == Side.Floor ? 0.025 : 0.13;
            _mesh.AddPlate(frame, new(-0.01, 0, width + 0.01, RibWidth), height, 0.03);
            _mesh.AddPlate(frame.Translated(0, 0, height), new(0.12, 0.07, width - 0.12, RibWidth - 0.07), 0.02, 0.01);
            var bolts = _isPlain ? 0 : 2 + (int)Math.Min(6, 2 * Math.Sqrt(_detail));
            for (var bolt = 0; bolt < bolts && side != Side.Floor; bolt++)
            {
                var x = 0.08 + ((width - 0.16) * bolt / (bolts - 1));
                _mesh.AddBolt(frame.Translated(0, 0, height), x, 0.05, 0.014);
                _mesh.AddBolt(frame.Translated(0, 0, height), x, RibWidth - 0.05, 0.014);
            }
        }
    }

    private void AddPipes(SplitMix64 random)
    {
        var sides = (int)Math.Clamp(6 + (2 * Math.Sqrt(_detail)), 6, 24);
        var perBay = (int)Math.Clamp(4 + (4 * Math.Sqrt(_detail)), 4, 40);
        foreach (var (x, y, radius) in ((double, double, double)[])[
            (1.12, 2.5, 0.07), (1.28, 2.36, 0.05), (1.4, 2.24, 0.035), (-1.15, 2.48, 0.085), (-1.35, 2.28, 0.045),
            (1.42, 0.5, 0.05), (-1.42, 0.5, 0.05), (-1.3, 0.41, 0.03)])
        {
            AddPipe(x, y, radius, perBay, sides, random);
        }

        for (var bay = 0; bay < Bays; bay++)
        {
            AddCable(bay, perBay, Math.Max(5, sides - 2), random);
        }
    }

    /// <summary>Adds a pipe along the whole corridor with a collar at each rib; in some bays it swings out from the wall.</summary>
    private void AddPipe(double x, double y, double radius, int perBay, int sides, SplitMix64 random)
    {
        var points = new List<Vector>();
        for (var bay = 0; bay < Bays; bay++)
        {
            var swing = random.Chance(0.3) ? random.NextInRange(0.04, 0.1) : 0;
            for (var segment = 0; segment < perBay; segment++)
            {
                var along = (double)segment / perBay;
                var offset = swing * SmoothStep(Math.Clamp((Math.Abs(along - 0.5) - 0.2) * -8 + 0.8, 0, 1));
                points.Add(new(x - (Math.Sign(x) * offset), y - (Math.Sign(y - 1.4) * offset), (bay + along) * BayLength));
            }

            if (!_isPlain)
            {
                AddCollar(new(x, y, (bay * BayLength) + (RibWidth / 2)), radius, sides);
            }
        }

        points.Add(new(x, y, Length));
        _mesh.AddTube(points, _ => radius, sides);
    }

    private void AddCollar(Vector start, double radius, int sides)
    {
        double[] steps = [1, 1.45, 1.45, 1];
        Vector[] points = [start, start + (0.005 * Vector.K), start + (0.05 * Vector.K), start + (0.055 * Vector.K)];
        _mesh.AddTube(points, i => steps[i] * radius, sides);
    }

    /// <summary>Adds a cable that hangs from rib to rib under the ceiling.</summary>
    private void AddCable(int bay, int segments, int sides, SplitMix64 random)
    {
        var x = random.NextInRange(-0.75, 0.75);
        var sag = random.NextInRange(0.05, 0.2);
        var drift = random.NextInRange(-0.2, 0.2);
        var points = new Vector[segments + 1];
        for (var segment = 0; segment <= segments; segment++)
        {
            var along = (double)segment / segments;
            points[segment] = new(x + (drift * along), 2.61 - (4 * sag * along * (1 - along)), (bay + along) * BayLength);
        }

        _mesh.AddTube(points, _ => 0.014, sides);
    }

    /// <summary>Adds a round hatch in a bulkhead: rings, a wheel with spokes, bolts around.</summary>
    private void AddHatch(WallFrame frame)
    {
        var segments = (int)Math.Clamp(24 + (8 * Math.Sqrt(_detail)), 24, 160);
        var sides = (int)Math.Clamp(6 + (2 * Math.Sqrt(_detail)), 6, 24);
        _mesh.AddWall(frame, new(-1.62, -1.4, 1.62, 1.4));
        _mesh.AddRing(frame, 0, 0, 1.02, 0.09, segments, sides);
        _mesh.AddRing(frame.Translated(0, 0, 0.04), 0, 0, 0.8, 0.04, segments, sides);
        _mesh.AddRing(frame.Translated(0, 0, 0.16), 0, 0, 0.3, 0.03, segments, sides);
        for (var spoke = 0; spoke < 5; spoke++)
        {
            var (s, c) = Math.SinCos(2 * Math.PI * spoke / 5);
            _mesh.AddTube([frame.At(0, 0, 0.1), frame.At(0.3 * c, 0.3 * s, 0.16)], _ => 0.02, sides);
        }

        _mesh.AddPlate(frame, new(-0.12, -0.12, 0.12, 0.12), 0.13, 0.05);
        for (var bolt = 0; bolt < 24 && !_isPlain; bolt++)
        {
            var (s, c) = Math.SinCos(2 * Math.PI * bolt / 24);
            _mesh.AddBolt(frame, 0.91 * c, 0.91 * s, 0.025);
        }
    }

    private static double SmoothStep(double t) => t * t * (3 - (2 * t));
}
