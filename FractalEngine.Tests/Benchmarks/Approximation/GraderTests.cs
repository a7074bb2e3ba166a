using System.Collections.Immutable;
using FractalEngine.Benchmarks.Approximation.Unseen;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Tests.Benchmarks.Approximation;

public class GraderTests
{
    private static readonly UnseenInput Input = UnseenFractals.Create(FractalKind.TreeWithIdentity, 1, 1000);

    private static double Diagonal => Input.Clean.Bounds.Diagonal;

    private static double Tolerance => Damage.None.Tolerance(Input);

    [Fact]
    public void Compare_OfTheModelItself_FindsAll()
    {
        Grade[] grades =
        [
            Grader.Compare(Input.Clean, Input, 0), Grader.Compare(Input.Mesh, Input, 0),
            Grader.CompareSurfaces(Input.Clean, Input, Tolerance),
        ];
        Assert.All(grades, grade =>
        {
            Assert.Equal((1, 1, Input.ElementCount, true), (grade.Recall, grade.Precision, grade.FoundElements, grade.IsFound));
            // Rounding of a closest point on a face.
            Assert.InRange(grade.LargestDistance, 0, 1e-14);
        });
    }

    [Fact]
    public void Compare_OfOneMovedElement_MissesItAndFindsStrangers()
    {
        var moved = Input.Elements[7];
        var vertices = UnseenOracle.VerticesOf(Input, moved);
        var positions = MeshTools.Positions(Input.Clean);
        foreach (var vertex in vertices)
        {
            positions[vertex] += 0.9 * Diagonal * Vector.I;
        }

        var grade = Grader.Compare(MeshTools.Create(positions, Input.Clean.VertexIndices), Input, Tolerance);
        Assert.Equal(Input.ElementCount - 1, grade.FoundElements);
        Assert.Equal(1 - ((double)vertices.Length / Input.Clean.VertexCount), grade.Precision, 1e-12);
        Assert.False(grade.IsFound);
        Assert.InRange(grade.ExpansionToClean, 1e-3, 0.9);
    }

    [Fact]
    public void Compare_OfASlightlyMovedElement_DependsOnTheTolerance()
    {
        var positions = MeshTools.Positions(Input.Clean);
        foreach (var vertex in UnseenOracle.VerticesOf(Input, Input.Elements[^1]))
        {
            positions[vertex] += 2 * Tolerance * Vector.J;
        }

        var mesh = MeshTools.Create(positions, Input.Clean.VertexIndices);
        Assert.Equal(Input.ElementCount - 1, Grader.Compare(mesh, Input, Tolerance).FoundElements);
        var grade = Grader.Compare(mesh, Input, 2.001 * Tolerance);
        Assert.True(grade.IsFound);
        Assert.Equal(2 * Tolerance / Diagonal, grade.LargestDistance, 1e-12);
        Assert.Equal(2 * Tolerance / Input.SmallestElement, grade.DistanceInElements, 1e-9);
    }

    [Fact]
    public void Compare_OfAMissingElement_LosesRecallOnly()
    {
        var (first, count) = (Input.Elements[20].FirstFace, Input.Elements[20].FaceCount);
        var mesh = new Mesh(Input.Clean.Positions, Input.Clean.VertexIndices.RemoveRange(3 * first, 3 * count));
        var grade = Grader.Compare(mesh, Input, Tolerance);
        // Its vertices are still there, but no face uses them.
        Assert.Equal((Input.ElementCount - 1, 1.0, 0.0), (grade.FoundElements, grade.Precision, grade.ExpansionToClean));
        Assert.True(grade.CleanToExpansion > 0);
    }

    [Fact]
    public void Compare_OfAnEmptyExpansion_FindsNothing()
    {
        foreach (var grade in new[] { Grader.Compare(Mesh.Empty, Input, Tolerance), Grader.CompareSurfaces(Mesh.Empty, Input, Tolerance) })
        {
            Assert.Equal((0, 0, 0.0, double.PositiveInfinity), (grade.FoundElements, grade.Recall, grade.Precision, grade.LargestDistance));
        }
    }

    [Fact]
    public void Compare_OfDistances_IsThatOfAllPairs()
    {
        var mesh = new Damage(DamageKind.MissingAndStrangers, 0.5, 0.5).Apply(Input, 3).Mesh;
        var grade = Grader.Compare(mesh, Input, Tolerance);
        // The same squares in another order of points.
        Assert.Equal(LargestOfClosest(Input.Clean, mesh) / Diagonal, grade.CleanToExpansion, 1e-15);
        Assert.Equal(LargestOfClosest(mesh, Input.Clean) / Diagonal, grade.ExpansionToClean, 1e-15);
    }

    [Theory]
    [InlineData(0)]
    [InlineData(1)]
    [InlineData(8)]
    [InlineData(9)]
    [InlineData(1000)]
    public void PointTree_OfPointsSomeOfThemEqual_FindsTheClosest(int count)
    {
        var random = new SeededRandom("tree", count);
        var points = ImmutableArray.CreateRange(Enumerable.Range(0, count)
            .Select(i => i % 3 == 0 ? new Vector(random.Integer(0, 2), random.Integer(0, 2), 0) : random.InBox(2)));
        var (tree, last) = (new PointTree([.. points]), -1);
        for (var i = 0; i < 200; i++)
        {
            var position = random.InBox(3);
            var expected = points.Select(point => (point - position).LengthSquared()).Append(double.PositiveInfinity).Min();
            Assert.Equal(expected, tree.DistanceSquared(position, ref last));
        }
    }

    private static double LargestOfClosest(Mesh from, Mesh to) =>
        MeshTools.Positions(from).Max(position => MeshTools.Positions(to).Min(other => (other - position).Length()));
}
