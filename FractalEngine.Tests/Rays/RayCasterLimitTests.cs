using FractalEngine.Core.Fractals;
using FractalEngine.Core.Generation;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Queries;
using FractalEngine.Core.Rays;
using FractalEngine.Core.Scenes;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Rays;

/// <summary>Tests rays at the limits of what the documentation promises: ties, grazing, surfaces, zeros, errors, sizes, nothing.</summary>
public class RayCasterLimitTests
{
    // Two triangles that make the unit square at z = 0, facing up, and the same square below.
    private static readonly Mesh Squares = new(
        [0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, -1, 1, 0, -1, 1, 1, -1, 0, 1, -1], [0, 1, 2, 0, 2, 3, 4, 5, 6, 4, 6, 7]);

    /// <summary>The casters of a mesh, and of a fractal that is that mesh.</summary>
    public static TheoryData<string> Kinds => ["mesh", "fractal", "model"];

    [Theory]
    [MemberData(nameof(Kinds))]
    public void FindNearest_OfARayFromAbove_TellsAllOfTheHit(string kind)
    {
        var hit = Assert.NotNull(Create(kind, Squares).FindNearest(new(new(0.75, 0.25, 3), new(0, 0, -0.5))));
        Assert.Equal(3, hit.Distance);
        Assert.Equal(new(0.75, 0.25, 0), hit.Point);
        Assert.Equal(Vector.K, hit.Normal);
        Assert.True(hit.IsFrontFace);
        Assert.Equal(0, hit.FaceIndex);
        Near.Equal(new(0.25, 0.5, 0.25), hit.Barycentrics, 1e-15);
    }

    [Theory]
    [MemberData(nameof(Kinds))]
    public void FindNearest_OfARayFromBelow_KeepsTheNormalAndTellsTheBack(string kind)
    {
        var hit = Assert.NotNull(Create(kind, Squares).FindNearest(new(new(0.25, 0.75, -3), Vector.K)));
        Assert.Equal((2.0, 3, false), (hit.Distance, hit.FaceIndex, hit.IsFrontFace));
        Assert.Equal(Vector.K, hit.Normal);
    }

    [Theory]
    [MemberData(nameof(Kinds))]
    public void TryFindNearest_WithLimits_FindsWhatLiesBetweenThem(string kind)
    {
        var caster = Create(kind, Squares);
        var context = new QueryContext();
        var ray = new Ray(new(0.75, 0.25, 3), -Vector.K);
        foreach (var (minDistance, maxDistance, expected) in new[]
            { (0, 10, 3.0), (3, 3, 3.0), (3.5, 10, 4.0), (4, double.PositiveInfinity, 4.0), (0, 2.9, double.NaN), (3.1, 3.9, double.NaN),
              (4.1, 9, double.NaN), (5, 1, double.NaN) })
        {
            var isFound = caster.TryFindNearest(ray, context, out var hit, minDistance, maxDistance);
            Assert.Equal(expected, isFound ? hit.Distance : double.NaN);
            Assert.Equal(isFound, caster.HitsAny(ray, context, minDistance, maxDistance));
        }
    }

    [Theory]
    [MemberData(nameof(Kinds))]
    public void TryFindNearest_OfARayThatStartsOnASurface_FindsItAtZero(string kind)
    {
        var caster = Create(kind, Squares);
        foreach (var direction in new[] { Vector.K, -Vector.K, new(0.3, 0.1, 1), new(0.1, 0.2, -1) })
        {
            var ray = new Ray(new(0.75, 0.25, 0), direction);
            Assert.Equal(0, Assert.NotNull(caster.FindNearest(ray)).Distance);
            var isFound = caster.TryFindNearest(ray, new(), out var hit, 1e-9);
            Assert.Equal(direction.Z < 0, isFound);
            Assert.True(!isFound || (hit.Point.Z == -1 && hit.Distance >= 1));
        }
    }

    /// <summary>Rounding is larger than all that is searched there, and floats do not reach so far.</summary>
    [Theory]
    [MemberData(nameof(Kinds))]
    public void TryFindNearest_FromAnywhereWithinTheLimit_Ends(string kind)
    {
        var caster = Create(kind, MeshGenerators.Create("icosphere", 0, 1280));
        var context = new QueryContext();
        var random = new Random(7);
        for (var exponent = 0; exponent <= 75; exponent++)
        {
            for (var i = 0; i < 20; i++)
            {
                var direction = random.Vector();
                // Half of them along an axis, where the middle is met exactly.
                direction = i % 2 == 0 ? direction : Math.CopySign(1, direction.X) * Vector.K;
                var far = (Math.Pow(10, exponent) / direction.MaxAbsComponent()) * direction;
                if (caster.TryFindNearest(new(-far, direction), context, out var hit))
                {
                    var difference = Math.Abs(hit.Distance - far.Length());
                    Assert.True(difference <= 1 + (1e-12 * far.Length()), $"1e{exponent}, ray {i}: {hit.Distance}");
                }
                else
                {
                    Assert.True(exponent > 10, $"1e{exponent}, ray {i}: nothing");
                }
            }
        }
    }

    [Theory]
    [MemberData(nameof(Kinds))]
    public void TryFindNearest_OfATie_FindsOneOfTheFacesTheSameEachTime(string kind)
    {
        var caster = Create(kind, Squares);
        foreach (var (x, y) in new[] { (0.5, 0.5), (0.25, 0.25), (0.0, 0.0), (1.0, 1.0) })
        {
            var ray = new Ray(new(x, y, 2), -Vector.K);
            var first = Assert.NotNull(caster.FindNearest(ray));
            Assert.Equal(2, first.Distance);
            Assert.InRange(first.FaceIndex, 0, 1);
            Assert.Equal(first, caster.FindNearest(ray));
            Assert.Equal(first, Create(kind, Squares).FindNearest(ray));
        }
    }

    [Theory]
    [MemberData(nameof(Kinds))]
    public void FindNearest_OfARayInThePlaneOfFaces_HitsNoneOfThem(string kind)
    {
        var caster = Create(kind, Squares);
        foreach (var direction in new[] { Vector.I, new(1, 0.3, 0), new(1, -0.0, -0.0) })
        {
            Assert.Null(caster.FindNearest(new(new(-1, 0.2, 0), direction)));
            Assert.False(caster.HitsAny(new(new(-1, 0.2, 0), direction), new()));
        }
    }

    [Theory]
    [MemberData(nameof(Kinds))]
    public void FindNearest_OfAGrazingRay_HitsWhereItMeetsTheFace(string kind)
    {
        // It sinks by the slope on each unit, from the height that makes it meet the plane at x = 0.75.
        var caster = Create(kind, Squares);
        foreach (var slope in new[] { 1e-3, 1e-6, 1e-9, 1e-12 })
        {
            var hit = Assert.NotNull(caster.FindNearest(new(new(-1, 0.25, 1.75 * slope), new(1, 0, -slope))));
            Near.Equal(new(0.75, 0.25, 0), hit.Point, 1e-15 / slope);
            Assert.InRange(Math.Abs(hit.Point.Z), 0, 1e-15);
        }
    }

    [Theory]
    [MemberData(nameof(Kinds))]
    public void FindNearest_OfDegenerateTriangles_HitsNone(string kind)
    {
        var mesh = new Mesh([0, 0, 0, 1, 0, 0, 2, 0, 0, 0.5, 0.5, 0.5], [0, 1, 2, 3, 3, 3, 0, 1, 1]);
        var caster = Create(kind, mesh);
        Assert.Null(caster.FindNearest(new(new(0.5, 0, 3), -Vector.K)));
        Assert.Null(caster.FindNearest(new(new(0.5, 0.5, 3), -Vector.K)));
        Assert.Null(caster.FindNearest(new(new(-1, 0, 0), Vector.I)));
        Assert.Null(caster.FindNearest(new(Vector.Zero, Vector.One)));
    }

    [Theory]
    [MemberData(nameof(Kinds))]
    public void FindNearest_OfNothing_FindsNothing(string kind)
    {
        var caster = Create(kind, Mesh.Empty);
        Assert.Null(caster.FindNearest(new(Vector.Zero, Vector.I)));
        Assert.False(caster.HitsAny(new(Vector.Zero, Vector.I), new()));
        Assert.False(caster.TryFindNearest(new(Vector.Zero, Vector.I), new(), out var hit));
        Assert.Equal(default, hit);
    }

    [Fact]
    public void FindNearest_OfAFractalWithoutInstances_FindsNothing() =>
        Assert.Null(RayCaster.For(Fractal.Of(Squares).Apply([])).FindNearest(new(new(0.75, 0.25, 3), -Vector.K)));

    [Theory]
    [MemberData(nameof(Kinds))]
    public void Rays_OfWrongArguments_AreRefused(string kind)
    {
        var caster = Create(kind, Squares);
        var context = new QueryContext();
        double[] bad = [double.NaN, double.PositiveInfinity, double.NegativeInfinity];
        Ray[] rays =
        [
            new(Vector.Zero, Vector.Zero), default,
            .. bad.Select(x => new Ray(new(0, x, 0), Vector.I)), .. bad.Select(x => new Ray(Vector.Zero, new(1, 0, x))),
        ];
        foreach (var ray in rays)
        {
            Assert.ThrowsAny<ArgumentException>(() => caster.FindNearest(ray));
            Assert.ThrowsAny<ArgumentException>(() => caster.HitsAny(ray, context));
            Assert.ThrowsAny<ArgumentException>(() => caster.TryFindNearest(ray, context, out _));
        }

        var good = new Ray(Vector.Zero, Vector.I);
        foreach (var distance in new[] { -1, double.NaN, -double.Epsilon })
        {
            Assert.ThrowsAny<ArgumentException>(() => caster.HitsAny(good, context, distance));
            Assert.ThrowsAny<ArgumentException>(() => caster.HitsAny(good, context, 0, distance));
            Assert.ThrowsAny<ArgumentException>(() => caster.TryFindNearest(good, context, out _, distance));
            Assert.ThrowsAny<ArgumentException>(() => caster.TryFindNearest(good, context, out _, 0, distance));
        }

        Assert.Throws<ArgumentNullException>(() => caster.TryFindNearest(good, null!, out _));
    }

    [Fact]
    public void For_OfNull_IsRefused()
    {
        Assert.Throws<ArgumentNullException>(() => RayCaster.For((Mesh)null!));
        Assert.Throws<ArgumentNullException>(() => RayCaster.For((Fractal)null!));
    }

    [Fact]
    public void For_OfASingularMap_IsRefused()
    {
        var flat = new Transformation(Vector.Zero, Vector.Zero, new(0.5, 0, 0.5));
        Assert.Throws<SingularMatrixException>(() => RayCaster.For(Samples.Repeated(3, flat, Samples.MoveAndScale(1, 0, 0, 0.5))));
    }

    [Theory]
    [MemberData(nameof(Kinds))]
    public void FindNearest_WithDirectionsOfAnyLength_GivesTheSameDistance(string kind)
    {
        var caster = Create(kind, Squares);
        foreach (var length in new[] { 1e-320, 1e-300, 1e-160, 1e-5, 1, 1e5, 1e160, 1e300, double.MaxValue })
        {
            var hit = Assert.NotNull(caster.FindNearest(new(new(0.75, 0.25, 3), new(0, 0, -length))));
            Near.Equal(3, hit.Distance, 1e-15);
            Assert.Equal(0, hit.FaceIndex);
        }
    }

    [Theory]
    [InlineData(1e-100)]
    [InlineData(1e-30)]
    [InlineData(1e30)]
    [InlineData(1e100)]
    public void FindNearest_OfHugeAndTinyShapes_ScalesTheDistance(double scale)
    {
        var mesh = Squares.Transform(v => scale * v);
        var fractal = Fractal.Of(mesh).Apply([Transformation.Identity, Samples.Move(0, 0, -3 * scale)]);
        foreach (var caster in new[] { RayCaster.For(mesh), RayCaster.For(fractal) })
        {
            var hit = Assert.NotNull(caster.FindNearest(new(scale * new Vector(0.75, 0.25, 3), -Vector.K)));
            Near.Equal(3, hit.Distance / scale, 1e-14);
            Assert.Equal((0, true), (hit.FaceIndex, hit.IsFrontFace));
            Assert.Null(caster.FindNearest(new(scale * new Vector(1.25, 0.25, 3), -Vector.K)));
        }
    }

    [Theory]
    [InlineData(1e3)]
    [InlineData(1e6)]
    [InlineData(1e9)]
    public void FindNearest_FromFarAway_IsExactToTheReach(double distance)
    {
        var caster = Create("fractal", Squares);
        Seeded.Run(50, random =>
        {
            var direction = new Vector(random.Between(-1, 1), random.Between(-1, 1), -1).UnitVector();
            var hit = caster.FindNearest(new(new Vector(0.6, 0.3, 0) - (distance * direction), direction));
            // The last places of the origin, on a slope of at most 2.
            Near.Equal(distance, Assert.NotNull(hit).Distance, 1e-15 * distance);
        });
    }

    [Fact]
    public void PointAt_OfADistance_IgnoresTheLengthOfTheDirection() =>
        Assert.Equal(new(1, 2, 8), new Ray(new(1, 2, 3), new(0, 0, 77)).PointAt(5));

    [Fact]
    public void TextureCoordinates_OfAHit_AreInterpolated()
    {
        var mesh = Squares.WithTextureCoordinates([0, 0, 1, 0, 1, 1], [0, 1, 2, -1, -1, -1, 0, 0, 0, 1, 1, 1]);
        var caster = RayCaster.For(mesh);
        var (u, v) = Assert.NotNull(Assert.NotNull(caster.FindNearest(new(new(0.75, 0.25, 3), -Vector.K))).TextureCoordinates(mesh));
        Near.Equal(0.75, u, 1e-15);
        Near.Equal(0.25, v, 1e-15);
        Assert.Null(Assert.NotNull(caster.FindNearest(new(new(0.25, 0.75, 3), -Vector.K))).TextureCoordinates(mesh));
        Assert.Null(Assert.NotNull(caster.FindNearest(new(new(0.75, 0.25, 3), -Vector.K))).TextureCoordinates(Squares));
    }

    /// <summary>The fractal has the mesh as one of two instances; the other lies far off the rays of these tests.</summary>
    private static RayCaster Create(string kind, Mesh mesh)
    {
        var fractal = Fractal.Of(mesh).Apply([Transformation.Identity, Samples.Move(1e3, 0, 0)]);
        return kind switch
        {
            "mesh" => RayCaster.For(mesh),
            "fractal" => RayCaster.For(fractal),
            _ => Model.Of(fractal).CreateRayCaster(),
        };
    }
}
