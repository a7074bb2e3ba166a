using FractalEngine.Core.Fractals;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics;
using FractalEngine.Core.Physics.Descriptions;
using FractalEngine.Core.Scenes;
using FractalEngine.Tests.Physics.Rigid;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Physics.Thrown;

/// <summary>
/// What is thrown at random, at sizes from 1e-6 to 1e6: within a closed mesh, also around a fractal, before a plate that moves or turns by
/// itself, or at each other in empty space.
/// </summary>
internal sealed class ThrownWorld
{
    // No two bodies overlap at these distances, nor what stands in the middle.
    private const double Spacing = 3.1;
    private const double MaxRadius = 1.5;

    // As seen from a body, in sizes: it doesn't get past a plate within the steps that are made.
    private const double PlateHalfWidth = 2e5;

    private readonly List<PlacedModel> _objects = [];

    public ThrownWorld(Random random)
    {
        Size = Math.Pow(10, random.Between(-6, 6));
        var place = random.Draw((30, "box"), (20, "box with fractal"), (25, "space"), (15, "plate"), (10, "turning plate"));
        IsFree = place == "space";
        HasPlate = place.EndsWith("plate", StringComparison.Ordinal);
        TimeStep = place == "turning plate" ? 1e-3 : 1 / 60.0;
        var rows = HasPlate ? 2 : random.Draw((2, 2), (3, 3), (2, 5));
        var isCrowd = rows > 2;
        var isFast = !isCrowd && random.Next(4) == 0;
        StepCount = HasPlate ? 3 : random.Next(4, isCrowd || isFast ? 8 : 16);
        // The more bodies, the slower: what is hit thousands of times a step takes seconds.
        var maxRate = isCrowd ? 2 : isFast ? 6 : 3.5;
        var fall = random.Draw((1, 0), (1, 9.8), (2, Size * Math.Pow(10, random.Between(-1, maxRate))));
        var down = random.Next(2) == 0 ? -Vector.J : random.Direction();
        Gravity = IsFree ? Vector.Zero : Math.Min(fall, Size * Math.Pow(10, maxRate)) * down;
        var places = CreatePlaces(rows, place == "box with fractal");
        random.Shuffle(places);
        var count = isCrowd ? places.Length : random.Next(IsFree ? 2 : 1, isFast ? 4 : 9);
        AddBodies(random, places.Take(count), DrawShapes(random, rows), maxRate);
        if (HasPlate)
        {
            AddPlate(random, place == "turning plate");
        }
        else if (!IsFree)
        {
            var farthest = (0.5 * Math.Sqrt(3) * (rows - 1) * Spacing) + MaxRadius;
            AddWalls(random, Size * Math.Pow(10, random.Between(0, 0.7)) * farthest);
        }

        if (place == "box with fractal")
        {
            AddFractal(random);
        }

        var names = string.Join(", ", Shapes.CountBy(static shape => shape.Name).Select(static pair => $"{pair.Value} {pair.Key}"));
        Name = FormattableString.Invariant($"{place}, {names}, size {Size:g3}, gravity {Gravity.Length() / Size:g3} sizes/s², ")
            + FormattableString.Invariant($"up to {Bodies.Max(static body => body.Velocity.Length()) / Size:g3} sizes/s");
    }

    /// <summary>What is thrown, where, and how fast, in sizes and seconds.</summary>
    public string Name { get; }

    public double Size { get; }

    public Vector Gravity { get; }

    public double TimeStep { get; }

    public int StepCount { get; }

    /// <summary>True where there is nothing but bodies.</summary>
    public bool IsFree { get; }

    /// <summary>True for a plate, the top of which is the plane y = 0 of its own.</summary>
    public bool HasPlate { get; }

    public List<BodyDescription> Bodies { get; } = [];

    public List<ThrownShape> Shapes { get; } = [];

    /// <summary>The planes of the walls, their normals inwards.</summary>
    public List<(Vector Point, Vector Normal)> Walls { get; } = [];

    /// <summary>The cubes of the fractal that stands in the middle, none where nothing does.</summary>
    public PlacedPart[] Standing { get; private set; } = [];

    /// <summary>The farthest that anything gets from the origin, for rounding.</summary>
    public double MaxCoordinate { get; private set; }

    public PhysicsWorld Create(int threads)
    {
        var world = TestWorlds.Create(Gravity, new PhysicsSettings { TimeStep = TimeStep, MaxThreads = threads }, [.. _objects]);
        world.AddRange(Bodies);
        return world;
    }

    private static Vector[] CreatePlaces(int rows, bool isMiddleTaken)
    {
        var coordinates = Enumerable.Range(0, rows).Select(i => (i - (0.5 * (rows - 1))) * Spacing).ToArray();
        return
        [
            .. from x in coordinates
               from y in coordinates
               from z in coordinates
               where !isMiddleTaken || new Vector(x, y, z).Length() > 2
               select new Vector(x, y, z),
        ];
    }

    private static ThrownShape[] DrawShapes(Random random, int rows) => random.Draw<ThrownShape[]>(
        (30, ThrownShape.Balls), (20, [.. ThrownShape.Balls, .. ThrownShape.Compounds]), (35, ThrownShape.Meshes),
        (rows > 3 ? 0 : 15, ThrownShape.Fractals),
        (15, [.. ThrownShape.Balls, .. ThrownShape.Compounds, .. ThrownShape.Meshes, .. rows > 3 ? [] : ThrownShape.Fractals]));

    /// <summary>Adds a body at each of some places, which flies anywhere, or to where all others do.</summary>
    private void AddBodies(Random random, IEnumerable<Vector> places, ThrownShape[] shapes, double maxRate)
    {
        var maxSpeed = random.Next(6) == 0 ? 0 : Size * Math.Pow(10, random.Between(-1, maxRate));
        var maxSpin = random.Next(4) == 0 ? 0 : 2 * Math.PI * Math.Pow(10, random.Between(-2, 0.5 * maxRate));
        var restitution = random.Draw((1, 0), (1, 1), (1, random.NextDouble()));
        var friction = random.Next(2) * random.NextDouble();
        foreach (var place in places)
        {
            var shape = shapes[random.Next(shapes.Length)];
            Shapes.Add(shape);
            var direction = IsFree ? random.Vector(0.3) - place.UnitVectorOrZero() : random.Direction();
            Bodies.Add(shape.Describe(random, Size) with
            {
                Position = Size * (place + random.Vector(0.03)),
                Mass = Math.Pow(10, random.Between(-1, 1)) * (random.Next(2) == 0 ? Size * Size * Size : 1),
                Velocity = maxSpeed * random.NextDouble() * direction,
                AngularVelocity = maxSpin * random.NextDouble() * random.Direction(),
                Restitution = restitution,
                Friction = friction,
                IsRotationLocked = !IsFree && random.Happens(5),
            });
        }
    }

    /// <summary>Closes a mesh around all, convex, whose faces are no nearer than a distance, and may look to either side.</summary>
    private void AddWalls(Random random, double distance)
    {
        var mesh = random.Draw(
            (2, RigidMeshes.Box(2, 2, 2)), (1, Core.Generation.Shapes.Octahedron()), (1, Core.Generation.Shapes.Sphere(1)));
        var scale = distance / PhysicsMeshes.TrianglesOf(mesh).Min(static face => -PlaneOf(face).Offset);
        var turn = scale * (random.Next(2) == 0 ? Matrix.Identity : random.Orthogonal());
        mesh = mesh.Transform(vertex => turn * vertex);
        Walls.AddRange(PhysicsMeshes.TrianglesOf(mesh).Select(static face => (face.A, PlaneOf(face).Normal)));
        MaxCoordinate = scale * 2;
        _objects.Add(TestWorlds.Place(random.Next(2) == 0 ? mesh : PhysicsMeshes.FlipWinding(mesh)));
    }

    private static (Vector Normal, double Offset) PlaneOf((Vector A, Vector B, Vector C) face)
    {
        var normal = Vector.Cross(face.B - face.A, face.C - face.A).UnitVector();
        normal = Vector.Dot(normal, face.A) > 0 ? -normal : normal;
        return (normal, Vector.Dot(normal, face.A));
    }

    private void AddFractal(Random random)
    {
        var shape = ThrownShape.Fractals[random.Next(ThrownShape.Fractals.Length)];
        var placement = new Transformation(Vector.Zero, random.Degrees(), Size * random.Between(0.5, 1) * Vector.One);
        var map = placement.ToAffineMap();
        Standing = shape.Parts!.Place(point => map * point);
        _objects.Add(new(new SceneObject(shape.Describe(random, 1).Mesh!.Model) { Placement = placement }));
    }

    /// <summary>Adds a plate of one of three kinds, lifts all bodies above it, and lets half of them stand.</summary>
    private void AddPlate(Random random, bool isTurning)
    {
        var width = PlateHalfWidth * Size;
        var box = RigidMeshes.Box(new(-width, -Size, -width), new(width, 0, width));
        var quarters = new[] { -0.5, 0.5 }.SelectMany(
            static x => new[] { -0.5, 0.5 }.Select(z => Transformation.At(new Vector(x, 0, z), 0.5)));
        var plate = new SceneObject(random.Draw(
            (1, Model.Of(Core.Generation.Shapes.Square(2 * width))), (1, Model.Of(box)),
            (1, Model.Of(Fractal.Of(box).Repeat([.. quarters.Select(map => map with { Position = width * map.Position })], 5)))));
        var speed = Size * Math.Pow(10, random.Between(1, 6));
        var spin = ((2 * random.Next(2)) - 1) * Math.Pow(10, random.Between(1, 4.1));
        _objects.Add(new(plate with
        {
            Motion = isTurning ? new() { Spin = spin * Vector.K } : new() { Velocity = speed * new Vector(0.3 * random.Next(2), 1, 0) },
        }));
        MaxCoordinate = 2 * width;
        var lift = Size * new Vector(isTurning ? 100 : 0, random.Between(4, 60), 0);
        for (var i = 0; i < Bodies.Count; i++)
        {
            Bodies[i] = Bodies[i] with { Position = Bodies[i].Position + lift, Velocity = random.Next(2) * Bodies[i].Velocity };
        }
    }
}
