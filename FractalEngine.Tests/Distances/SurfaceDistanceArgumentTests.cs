using FractalEngine.Core.Distances;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Generation;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Distances;

/// <summary>Tests distances between surfaces at the limits of what has one, and how they end early.</summary>
public sealed class SurfaceDistanceArgumentTests
{
    [Fact]
    public void EmptyMesh_IsRefusedByItsName()
    {
        Mesh unused = new([0, 0, 0], []);
        Assert.Throws<ArgumentException>("from", () => SurfaceDistance.Between(unused, Shapes.Cube()));
        Assert.Throws<ArgumentException>("to", () => SurfaceDistance.Between(Shapes.Cube(), Mesh.Empty));
        Assert.Throws<ArgumentNullException>("to", () => SurfaceDistance.Between(Shapes.Cube(), null!));
    }

    [Fact]
    public void Settings_ThatMeanNothing_AreRefusedByTheirName()
    {
        Assert.All((double[])[-1, double.NaN, double.PositiveInfinity], number =>
        {
            Assert.Throws<ArgumentOutOfRangeException>("Tolerance", () => new SurfaceDistanceSettings { Tolerance = number });
            Assert.Throws<ArgumentOutOfRangeException>("Resolution", () => new SurfaceDistanceSettings { Resolution = number });
        });
        Assert.Throws<ArgumentOutOfRangeException>("MaxDivisions", () => new SurfaceDistanceSettings { MaxDivisions = -1 });
        Assert.Throws<ArgumentOutOfRangeException>("Samples", () => new SurfaceDistanceSettings { Samples = 0 });
        Assert.Throws<ArgumentOutOfRangeException>("MaxThreads", () => new SurfaceDistanceSettings { MaxThreads = 0 });
    }

    [Fact]
    public void FacesWithoutArea_HaveDistances()
    {
        Mesh point = new([3, 4, 0], [0, 0, 0]);
        Mesh segment = new([0, 0, 0, 2, 0, 0], [0, 1, 1, 0, 0, 1]);
        var distance = SurfaceDistance.Between(point, new([0, 0, 0], [0, 0, 0]));
        Near.Equal(5, distance.MaxDistance.Upper, 1e-13);
        Assert.Equal(5, distance.MeanDistance);
        // A point has no diagonal to compare with.
        Assert.Equal(double.PositiveInfinity, distance.RelativeMeanDistance);
        Assert.Equal(0, SurfaceDistance.Between(point, point).RelativeMeanDistance);
        distance = SurfaceDistance.Between(segment, point);
        Near.Equal(5, distance.Forward.MaxDistance.Lower, 1e-13);
        Near.Equal(Math.Sqrt(17), distance.Backward.MaxDistance.Upper, 1e-13);
    }

    [Fact]
    public void NoTolerance_EndsAtTheLastDigit()
    {
        var (mesh1, mesh2) = (Shapes.Cube(), Shapes.Tetrahedron());
        var bounds = SurfaceDistance.Between(mesh1, mesh2, new() { Tolerance = 0, Resolution = 0, MaxDivisions = 2000 }).MaxDistance;
        Near.Equal(bounds.Lower, bounds.Upper, 1e-9);
    }

    [Fact]
    public void UnusedVertices_AreNoPartOfTheSurface()
    {
        var cube = Shapes.Cube();
        Mesh withUnused = new([.. cube.Positions, 1e300, -1e300, 0], cube.VertexIndices);
        Assert.Equal(SurfaceDistance.Between(cube, Shapes.Sphere(1)), SurfaceDistance.Between(withUnused, Shapes.Sphere(1)));
    }

    [Fact]
    public void DistanceBeyondADouble_IsOverTheLimit()
    {
        var (mesh1, mesh2) = (Place(-1.7e308), Place(1.7e308));
        Assert.Throws<FractalLimitException>(() => SurfaceDistance.Between(mesh1, mesh2));

        static Mesh Place(double x) => new([x, 0, 0, x, 1, 0, x, 0, 1], [0, 1, 2]);
    }

    [Fact]
    public void Cancellation_EndsTheWork()
    {
        var turn = Matrix.Roll(SineCosine.FromDegrees(10));
        var (mesh1, mesh2) = (Shapes.Sphere(4), Shapes.Sphere(4).Transform(v => turn * v));
        Assert.Throws<OperationCanceledException>(() => SurfaceDistance.Between(mesh1, mesh2, cancellation: new(true)));
        using var source = new CancellationTokenSource();
        // A thread of its own, since those of the pool may be busy with other tests.
        new Thread(() =>
        {
            Thread.Sleep(50);
            source.Cancel();
        }).Start();
        var endless = new SurfaceDistanceSettings { Tolerance = 0, Resolution = 0, MaxDivisions = int.MaxValue, MaxThreads = 1 };
        Assert.Throws<OperationCanceledException>(() => SurfaceDistance.Between(mesh1, mesh2, endless, source.Token));
    }

    [Fact]
    public void Bounds_AreWrittenInTheInvariantCulture() =>
        Assert.Equal("0.25..0.5", InCulture.Run("de-DE", () => new DistanceInterval(0.25, 0.5).ToString()));
}
