using FractalEngine.Core.Fractals;
using FractalEngine.Core.Generation;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Geometry.Surfaces;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Parsing.Exports;
using FractalEngine.Tests.Render;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Geometry.Surfaces;

/// <summary>Tests welding by areas and volumes in closed form, and by how often faces pass each edge.</summary>
public class MeshWeldingTests
{
    private const double Tolerance = 1e-9;

    /// <summary>Two cubes side by side weld alike at any size and place that numbers can tell.</summary>
    [Theory]
    [InlineData(1, 0)]
    [InlineData(1e-300, 0)]
    [InlineData(1e-312, 0)]
    [InlineData(1e300, 0)]
    [InlineData(8e307, 0)]
    [InlineData(1, 1e12)]
    [InlineData(1, -1e15)]
    public void Weld_OfCubesOfAnySize_EndsAndJoinsThem(double size, double place)
    {
        var scene = RenderScenes.Scene(new(), (new FractalModel(
            Fractal.Of(new Mesh([.. Shapes.Cube().Positions.Select(x => place + (size * x))], Shapes.Cube().VertexIndices))
                .Apply([Transformation.Identity, Samples.Move(size, 0, 0)])), Transformation.Identity, null));
        var welded = JoinedScene.Of(scene, new(), isWelded: true).Objects[0].Model.Mesh;
        // Whether faces lie in one plane is not known where products of lengths are beyond numbers: then a wall may stay.
        Assert.InRange(welded.FaceCount, 20, size is > 1e-100 and < 1e100 ? 20 : 24);
        Assert.Equal(0, SurfaceEdges.Of(welded).OpenCount);
    }

    /// <summary>A face without an area has an edge from a vertex to itself, where nothing touches.</summary>
    [Fact]
    public void Edges_OfAFaceWithoutAnArea_AreNone() =>
        Assert.Equal(new(0, 0, null), SurfaceEdges.Of(new Mesh([0, 0, 0, 1, 1, 1], [0, 0, 0, 1, 1, 1])));

    [Fact]
    public void Weld_OfARowOfCubes_IsABox()
    {
        var welded = WeldCubes([new(0, 0, 0), new(2, 0, 0), new(4, 0, 0)]);
        // 6 sides each but two walls, and 4 corners a plane.
        Assert.Equal((28, 16), (welded.FaceCount, welded.VertexCount));
        Assert.Equal(new(0, 0, null), SurfaceEdges.Of(welded));
        Near.Equal((2 * 4) + (4 * 12), welded.SurfaceArea(), 1e-12);
    }

    [Fact]
    public void Weld_OfCubesThatDifferByRounding_IsClosed()
    {
        var welded = WeldCubes([new(0, 0, 0), new(2 + 2e-10, 3e-10, -1e-10)]);
        Assert.Equal((20, 12), (welded.FaceCount, welded.VertexCount));
        Assert.Equal(0, SurfaceEdges.Of(welded).OpenCount);
    }

    [Fact]
    public void Weld_OfCubesAHairApart_LeavesThem() => Assert.Equal(24, WeldCubes([new(0, 0, 0), new(2 + 1e-8, 0, 0)]).FaceCount);

    [Fact]
    public void Weld_OfTheSameCubeTwice_KeepsOne() => Assert.Equal(12, WeldCubes([new(0, 0, 0), new(0, 0, 0)]).FaceCount);

    /// <summary>In any order, what is on both sides of a wall takes the wall away.</summary>
    [Theory]
    [InlineData(0, 0, 2)]
    [InlineData(0, 2, 0)]
    [InlineData(2, 0, 0)]
    public void Weld_OfACubeTwiceBesideAnother_LeavesNoWall(double first, double second, double third)
    {
        var welded = WeldCubes([new(first, 0, 0), new(second, 0, 0), new(third, 0, 0)]);
        Assert.Equal(20, welded.FaceCount);
        Assert.Equal(new(0, 0, null), SurfaceEdges.Of(welded));
    }

    [Fact]
    public void Weld_OfCubesAlongAnEdge_TellsThatTheyTouch() =>
        Assert.Equal(new(0, 1, null), SurfaceEdges.Of(WeldCubes([new(0, 0, 0), new(2, 2, 0)])));

    [Theory]
    [InlineData(1)]
    [InlineData(2)]
    [InlineData(3)]
    public void Weld_OfAMengerSponge_HasItsSurfaceAndVolume(int depth)
    {
        var cube = RenderScenes.Cube(1);
        var maps = RenderScenes.Menger(depth).Fractal.Expand(10_000);
        var flat = cube.Flatten(maps);
        var sides = MeshWelding.FindSides(cube);
        var welded = MeshWelding.Weld(flat, [.. maps.SelectMany((_, i) => sides.Select(side => (12 * i) + side))], Tolerance);
        // The surface of the sponge in a cube of side 1 is 2 (20/9)ⁿ + 4 (8/9)ⁿ.
        Near.Equal(4 * ((2 * Math.Pow(20.0 / 9, depth)) + (4 * Math.Pow(8.0 / 9, depth))), welded.SurfaceArea(), 1e-9);
        Assert.Equal(0, SurfaceEdges.Of(welded).OpenCount);
        Near.Equal(8 * Math.Pow(20.0 / 27, depth), Volume(welded), 1e-9);
    }

    [Fact]
    public void Weld_WithGroups_KeepsTheirFaces()
    {
        var flat = RenderScenes.Cube(1).Flatten([AffineMap.Identity, AffineMap.Translate(new(2, 0, 0))])
            .WithGroups([new(0, 12, "", "", "a", 0), new(12, 12, "", "", "b", 0)], []);
        var welded = MeshWelding.Weld(flat, SidesOf(2), Tolerance);
        Assert.Equal([("a", 0, 10), ("b", 10, 10)], welded.Groups.Select(group => (group.Material, group.FirstFace, group.FaceCount)));
    }

    [Fact]
    public void SurfaceEdges_OfACubeWithoutAFace_NameAnOpenEdge()
    {
        var cube = RenderScenes.Cube(1);
        var open = new Mesh(cube.Positions, cube.VertexIndices[..^3]);
        var edges = SurfaceEdges.Of(open);
        Assert.Equal(3, edges.OpenCount);
        Assert.Equal(1, edges.FirstOpen!.Value.MaxAbsComponent());
    }

    private static Mesh WeldCubes(Vector[] places) => MeshWelding.Weld(
        RenderScenes.Cube(1).Flatten([.. places.Select(AffineMap.Translate)]), SidesOf(places.Length), Tolerance);

    private static int[] SidesOf(int cubes)
    {
        var sides = MeshWelding.FindSides(RenderScenes.Cube(1));
        Assert.Equal(6, sides.Distinct().Count());
        return [.. Enumerable.Range(0, cubes).SelectMany(cube => sides.Select(side => (12 * cube) + side))];
    }

    private static double Volume(Mesh mesh) => Enumerable.Range(0, mesh.FaceCount).Select(mesh.Face).Sum(
        static face => Vector.Dot(face.A, Vector.Cross(face.B, face.C)) / 6);
}
