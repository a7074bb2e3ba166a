using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Levels;
using FractalEngine.Core.Generation;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Queries;
using FractalEngine.Core.SceneQueries;
using FractalEngine.Core.Scenes;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.SceneQueries;

/// <summary>The choice of a face among all that shine, against every face of an expansion.</summary>
public class AreaLightSamplerTests
{
    /// <summary>Names of the fractals of <see cref="Shape"/>.</summary>
    public static TheoryData<string> Names =>
        ["mesh", "many faces", "similar", "skewed", "leaves", "calls", "wide", "chance", "sizes", "power"];

    [Theory]
    [MemberData(nameof(Names))]
    public void DensityOf_OverAllFaces_SumsToOne(string name)
    {
        foreach (var position in (Vector[])[new(0.1, -3, 0.2), new(40, 3, 2), new(0.3, 0.2, 0.1)])
        {
            foreach (var normal in (Vector[])[Vector.J, -Vector.J, new(0.6, 0, 0.8)])
            {
                var sum = ProbabilitiesOf(name, position, normal).Sum(static one => one.Probability);
                // A walk may end where chance or size leave nothing.
                Assert.True(name is "chance" or "sizes" ? sum is > 0.02 and < 1 + 1e-12 : Math.Abs(sum - 1) < 1e-12, $"{name}: {sum}");
            }
        }
    }

    [Fact]
    public void DensityOf_OverAllFacesOfRandomFractals_SumsToOne() => Seeded.Run(60, static random =>
    {
        var fractal = RandomFractals.Create(random);
        var scene = Scene(new FractalModel(fractal));
        var sampler = new AreaLightSampler(scene, static (_, face) => 1 + (face % 3));
        var sum = Enumerate(scene, sampler, random.Direction() * 3, random.Direction()).Sum(static one => one.Probability);
        Assert.True(sampler.IsEmpty ? sum == 0 : Math.Abs(sum - 1) < 1e-11, $"{sum}");
    });

    [Theory]
    [MemberData(nameof(Names))]
    public void TrySample_ManyTimes_FollowsTheDensity(string name)
    {
        var scene = Scene(Shape(name));
        var sampler = new AreaLightSampler(scene, static (_, face) => 1 + (face % 3));
        var (position, normal) = (new Vector(0.5, -2, 0.3), new Vector(0, 0.8, 0.6));
        var expected = Enumerate(scene, sampler, position, normal);
        var found = new Dictionary<string, int>();
        var random = new Random(7);
        var context = new QueryContext();
        const int Count = 40_000;
        for (var i = 0; i < Count; i++)
        {
            var point = (random.NextDouble(), random.NextDouble());
            if (sampler.TrySample(position, normal, random.NextDouble(), point, context, out var sample))
            {
                var key = $"{sample.ObjectIndex}|{string.Join(',', context.LightPath)}|{sample.FaceIndex}";
                found[key] = found.GetValueOrDefault(key) + 1;
            }
        }

        // Faces that are rarely chosen count as one, so that the sum follows the distribution.
        var (chiSquared, classes, rare, rareFound) = (0.0, 0, 1.0, Count);
        foreach (var (key, probability, _) in expected)
        {
            if (probability * Count >= 10)
            {
                chiSquared += Math.Pow(found.GetValueOrDefault(key) - (probability * Count), 2) / (probability * Count);
                (classes, rare, rareFound) = (classes + 1, rare - probability, rareFound - found.GetValueOrDefault(key));
            }
        }

        chiSquared += rare * Count >= 10 ? Math.Pow(rareFound - (rare * Count), 2) / (rare * Count) : 0;
        Assert.Subset(expected.Select(static one => one.Key).ToHashSet(), found.Keys.ToHashSet());
        // Five standard deviations.
        Assert.InRange(chiSquared, 0, classes + 1 + (5 * Math.Sqrt(2 * (classes + 1))));
    }

    [Theory]
    [InlineData("mesh")]
    [InlineData("many faces")]
    [InlineData("similar")]
    [InlineData("leaves")]
    [InlineData("calls")]
    [InlineData("wide")]
    [InlineData("power")]
    public void Power_OfSimilarities_IsTheSumOverTheExpansion(string name)
    {
        var scene = Scene(Shape(name));
        var sampler = new AreaLightSampler(scene, static (_, face) => 1 + (face % 3));
        var expected = Enumerate(scene, sampler, Vector.Zero, Vector.J).Sum(static one => one.Area * (1 + (int.Parse(
            one.Key.Split('|')[2], System.Globalization.CultureInfo.InvariantCulture) % 3)));
        Assert.Equal(expected, sampler.Power, 1e-12 * expected);
    }

    [Fact]
    public void StorageBytes_OfManyLamps_IsKilobytes()
    {
        // 3⁴² lamps, 10²⁰.
        var fractal = Fractal.Of(Shapes.Tetrahedron()).Repeat(Thirds, 42);
        var sampler = new AreaLightSampler(Scene(new FractalModel(fractal)), static (_, _) => 1);
        Assert.InRange((double)fractal.InstanceCount!, 1e20, 2e20);
        Assert.InRange(sampler.StorageBytes, 1000, 64_000);
        // The areas are 3/4 of those before at each level. The second object is larger.
        var area = (1 + (1.5 * 1.5)) * TotalArea(Shapes.Tetrahedron());
        Assert.Equal(area * Math.Pow(0.75, 42), sampler.Power, 1e-12 * sampler.Power);
        var context = new QueryContext();
        Assert.True(sampler.TrySample(new(0, -2, 0), Vector.J, 0.3, (0.5, 0.5), context, out _));
    }

    [Fact]
    public void DensityOf_NearALamp_IsThatOfIt()
    {
        // Beside one of many lamps on a line, that one is chosen in most cases: light falls with the square of the distance.
        var maps = Enumerable.Range(0, 200).Select(static i => Samples.Move(i, 0, 0));
        var scene = Scene(new FractalModel(Fractal.Of(Quad(0.1)).Apply(maps)));
        var sampler = new AreaLightSampler(scene, static (_, _) => 1);
        var near = Enumerate(scene, sampler, new(120, -0.25, 0), Vector.J).Where(static one => one.Probability > 0.1).ToArray();
        Assert.InRange(near.Sum(static one => one.Probability), 0.8, 1);
        // It and a neighbour, of two faces each.
        Assert.InRange(near.Length, 2, 4);
    }

    [Fact]
    public void IsEmpty_OfDarkInfiniteAndComponentwiseOnes_IsTrue()
    {
        Assert.True(new AreaLightSampler(Scene(Shape("similar")), static (_, _) => 0).IsEmpty);
        var infinite = new FractalModel(Fractal.Of(Shapes.Tetrahedron()).Repeat(Thirds));
        Assert.True(new AreaLightSampler(Scene(infinite), static (_, _) => 1).IsEmpty);
    }

    private static IEnumerable<Transformation> Thirds =>
        [Samples.MoveAndScale(0.5, 0, 0, 0.5), Samples.MoveAndScale(-0.5, 0, 0, 0.5), Samples.MoveAndScale(0, 0.5, 0, 0.5)];

    private static Vector Half => 0.5 * Vector.One;

    private static double TotalArea(Mesh mesh) => Enumerable.Range(0, mesh.FaceCount).Sum(face => Area(mesh.Face(face)));

    private static double Area((Vector A, Vector B, Vector C) face) => 0.5 * Vector.Cross(face.B - face.A, face.C - face.A).Length();

    private static Mesh Quad(double size) => new(
        [-size, 0, -size, size, 0, -size, size, 0, size, -size, 0, size], [0, 1, 2, 0, 2, 3]);

    private static Model Shape(string name)
    {
        var mesh = Shapes.Tetrahedron();
        Transformation[] turned =
        [
            new(new(0.8, 0.1, 0), new(10, 20, 30), Half), new(new(-0.7, 0.2, 0.3), new(0, 50, 0), 0.6 * Vector.One),
            new(new(0, 0.9, 0.1), new(80, 0, 10), 0.4 * Vector.One),
        ];
        Transformation[] skewed =
        [
            new(new(0.8, 0.1, 0), new(10, 20, 30), new(0.5, 0.3, 0.7)), new(new(-0.7, 0.2, 0.3), new(0, 50, 0), new(0.6, 0.5, 0.2)),
            new(new(0, 0.9, 0.1), new(80, 0, 10), new(0.4, 0.7, 0.4)),
        ];
        var lamp = Fractal.Of(mesh);
        return name switch
        {
            "mesh" => new MeshModel(mesh),
            "many faces" => new MeshModel(Shapes.Sphere(3)),
            "similar" => new FractalModel(lamp.Repeat(turned, 4)),
            "skewed" => new FractalModel(lamp.Repeat(skewed, 4)),
            "leaves" => new FractalModel(Fractal.Recurse(lamp, 4, self => self.Apply(turned) + Fractal.Of(Shapes.Cube()))),
            "calls" => new FractalModel(Fractal.Recurse(lamp, 3, self => self.Apply(turned) + Fractal.Recurse(
                Fractal.Of(Shapes.Cube()), 2, inner => inner.Apply(turned[..2]) + lamp).Apply(turned[1..]))),
            "wide" => new FractalModel(lamp.Repeat(
                Enumerable.Range(0, 90).Select(static i => Samples.Move(i % 10, i / 10, 0.01 * i) with { Scale = 0.1 * Vector.One }), 2)),
            "chance" => new FractalModel(Fractal.Recurse(
                lamp, 5, self => Fractal.Choose(3, (2, self.Apply(turned)), (1, self.Apply(turned[..1])), (1, lamp)))),
            "sizes" => new FractalModel(Fractal.RecurseUntil(lamp, 0.4, self => self.Apply(turned))),
            _ => new FractalModel(lamp.Repeat([Transformation.Identity, turned[0]], 6)),
        };
    }

    private static LoadedScene Scene(Model model) => LoadedScene.Of(new Scene
    {
        Objects =
        [
            new SceneObject(model), new SceneObject(model) { Placement = new(new(6, 1, -2), new(20, 40, 60), 1.5 * Vector.One) },
        ],
    });

    private static List<(string Key, double Probability, double Area)> ProbabilitiesOf(string name, Vector position, Vector normal)
    {
        var scene = Scene(Shape(name));
        return Enumerate(scene, new(scene, static (_, face) => 1 + (face % 3)), position, normal);
    }

    /// <summary>Asks for the density of every face of every instance.</summary>
    private static List<(string Key, double Probability, double Area)> Enumerate(
        LoadedScene scene, AreaLightSampler sampler, Vector position, Vector normal)
    {
        var result = new List<(string Key, double Probability, double Area)>();
        var context = new QueryContext();
        for (var index = 0; index < scene.Objects.Length; index++)
        {
            var placed = scene.Objects[index];
            if (placed.Model is not FractalModel { Fractal.Hierarchy: var hierarchy })
            {
                Add(index, [], placed.Model.Mesh, placed.ObjectToWorld);
                continue;
            }

            var open = new Stack<(LevelState State, SubFractal SubFractal, int[] Path, AffineMap Map)>();
            open.Push((hierarchy.Start, hierarchy.Root, [], placed.ObjectToWorld));
            while (open.TryPop(out var place))
            {
                if (hierarchy.IsBase(place.State.Level))
                {
                    Add(index, place.Path, hierarchy.BaseMeshes[place.SubFractal.BaseIndex], place.Map);
                    continue;
                }

                for (var i = 0; i < place.SubFractal.Children.Length; i++)
                {
                    var child = place.SubFractal.Children[i];
                    var state = hierarchy.Enter(child, in place.State);
                    open.Push((state, hierarchy.At(child, state.Level), [.. place.Path, i], place.Map * child.Map));
                }
            }
        }

        return result;

        void Add(int index, int[] path, Mesh mesh, AffineMap map)
        {
            for (var face = 0; face < mesh.FaceCount; face++)
            {
                context.ObjectIndex = index;
                path.CopyTo(context.BestPathBuffer(path.Length));
                context.ChildPathLength = path.Length;
                var (a, b, c) = mesh.Face(face);
                var area = Area((map * a, map * b, map * c));
                result.Add(($"{index}|{string.Join(',', path)}|{face}", area * sampler.DensityOf(position, normal, context, face), area));
            }
        }
    }
}
