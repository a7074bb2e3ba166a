using FractalEngine.Benchmarks.Approximation.Unseen;

namespace FractalEngine.Tests.Benchmarks.Approximation;

public class DamageTests
{
    private static readonly UnseenInput Tree = UnseenFractals.Create(FractalKind.TreeWithIdentity, 2, 1500);
    private static readonly UnseenInput Balls = WithBaseOf(BaseKind.Ball, 3100);
    private static readonly UnseenInput Boxes = WithBaseOf(BaseKind.Box, 1500);

    public static TheoryData<int> All => [.. Enumerable.Range(0, Damage.All.Length)];

    [Theory]
    [MemberData(nameof(All))]
    public void Apply_OfOneSeed_IsTheSame(int index)
    {
        var damage = Damage.All[index];
        var (first, again, other) = (damage.Apply(Balls, 1), damage.Apply(Balls, 1), damage.Apply(Balls, 2));
        Assert.Equal((first.Mesh, first.Description), (again.Mesh, again.Description));
        Assert.NotEqual(first.Mesh, other.Mesh);
        // The truth stays, and what was damaged before plays no part.
        Assert.Same(Balls.Clean, first.Clean);
        Assert.Equal(first.Mesh, damage.Apply(other, 1).Mesh);
    }

    [Fact]
    public void None_OfAModel_ChangesOrderOnly()
    {
        var mesh = Damage.None.Apply(Tree, 1).Mesh;
        Assert.Equal(UnseenOracle.FacesInOrder(Tree.Clean), UnseenOracle.FacesInOrder(mesh));
        Assert.NotEqual(Tree.Clean.VertexIndices.AsEnumerable(), mesh.VertexIndices);
        // What was wound alike has turned faces now: each turned one passes its edges as its neighbours do.
        Assert.Equal(0, UnseenOracle.CountBadEdges(Boxes.Clean).Doubled);
        var box = Damage.None.Apply(Boxes, 1).Mesh;
        Assert.InRange(UnseenOracle.CountBadEdges(box).Doubled, 0.2 * box.FaceCount, 0.3 * box.FaceCount);
    }

    [Theory]
    [InlineData(DamageKind.Noise, 0.01)]
    [InlineData(DamageKind.Noise, 0.001)]
    [InlineData(DamageKind.NoiseOfDiagonal, 1e-4)]
    internal void Noise_OfAModel_MovesVerticesUpToItsRadius(DamageKind kind, double amount)
    {
        var radius = amount * (kind == DamageKind.Noise ? Boxes.SmallestElement : Boxes.Clean.Bounds.Diagonal);
        var mesh = new Damage(kind, amount).Apply(Boxes, 1).Mesh;
        Assert.Equal((Boxes.Clean.FaceCount, Boxes.Clean.VertexCount), (mesh.FaceCount, mesh.VertexCount));
        var grade = Grader.Compare(mesh, Boxes, radius);
        // Of thousands of points in a ball some are near its surface.
        Assert.True(grade.IsFound);
        Assert.InRange(grade.LargestDistance * Boxes.Clean.Bounds.Diagonal, 0.9 * radius, radius);
    }

    [Theory]
    [InlineData(0.5, 0)]
    [InlineData(0.3, 0.3)]
    [InlineData(0.8, 0.8)]
    public void Missing_OfAModel_HasAsManyElementsAsAsked(double missing, double strangers)
    {
        var damage = new Damage(DamageKind.MissingAndStrangers, missing, strangers);
        var mesh = damage.Apply(Boxes, 1).Mesh;
        var (count, faces) = (Boxes.ElementCount, Boxes.Bases[0].FaceCount);
        var (removed, added) = ((int)Math.Round(missing * count), (int)Math.Round(strangers * count));
        Assert.Equal((count - removed + added) * faces, mesh.FaceCount);
        var grade = Grader.Compare(mesh, Boxes, 1e-9 * Boxes.Clean.Bounds.Diagonal);
        Assert.Equal(count - removed, grade.FoundElements);
        Assert.Equal((double)(count - removed) / (count - removed + added), grade.Precision, 1e-12);
        // Strangers stand within the bounds, up to the rounding of a move.
        var (room, bounds) = (1e-12 * Boxes.Clean.Bounds.Diagonal, Boxes.Clean.Bounds);
        var (below, above) = (bounds.Minimum - mesh.Bounds.Minimum, mesh.Bounds.Maximum - bounds.Maximum);
        Assert.All(new[] { below.X, below.Y, below.Z, above.X, above.Y, above.Z }, beyond => Assert.True(beyond <= room));
    }

    [Fact]
    public void Missing_OfWhatRepeats_LeavesItsEnds()
    {
        var stairs = RepeatingModels.Create(RepeatKind.Stairs, 1, 30);
        Assert.Equal([0, 29], stairs.Ends.AsEnumerable());
        Assert.All(Enumerable.Range(0, 20), seed =>
        {
            var mesh = new Damage(DamageKind.Missing, 0.8).Apply(stairs, seed).Mesh;
            Assert.Equal((6 * stairs.Bases[0].FaceCount, stairs.Clean.Bounds), (mesh.FaceCount, mesh.Bounds));
        });
    }

    [Fact]
    public void SplitEdges_OfAModel_LeavesItsSurface()
    {
        var mesh = new Damage(DamageKind.SplitEdges, 0.2).Apply(Boxes, 1).Mesh;
        // A box has 18 edges, each between two faces: a split adds a vertex and two faces.
        var splits = (int)Math.Round(0.2 * 18 * Boxes.ElementCount);
        Assert.Equal(Boxes.Clean.VertexCount + splits, mesh.VertexCount);
        Assert.Equal(Boxes.Clean.FaceCount + (2 * splits), mesh.FaceCount);
        Assert.Equal(Boxes.Clean.SurfaceArea(), mesh.SurfaceArea(), 1e-9 * mesh.SurfaceArea());
        Assert.True(Grader.CompareSurfaces(mesh, Boxes, 1e-9 * mesh.Bounds.Diagonal).IsFound);
    }

    [Fact]
    public void FlippedEdges_OfBoxes_LeavesTheirSurfaceButNotTheirFaces()
    {
        var mesh = new Damage(DamageKind.FlippedEdges, 0.5).Apply(Boxes, 1).Mesh;
        Assert.Equal((Boxes.Clean.FaceCount, Boxes.Clean.VertexCount), (mesh.FaceCount, mesh.VertexCount));
        Assert.Equal(Boxes.Clean.SurfaceArea(), mesh.SurfaceArea(), 1e-9 * mesh.SurfaceArea());
        // Six diagonals a box, of which about a half are flipped: then two faces differ.
        var same = UnseenOracle.FacesInOrder(Boxes.Clean).Intersect(UnseenOracle.FacesInOrder(mesh)).Count();
        Assert.InRange(same, 0.4 * mesh.FaceCount, 0.6 * mesh.FaceCount);
    }

    [Fact]
    public void Decimated_OfBalls_HasHalfOfTheFacesAndAllComponents()
    {
        var mesh = new Damage(DamageKind.Decimated, 0.5).Apply(Balls, 1).Mesh;
        Assert.InRange(mesh.FaceCount, (Balls.Clean.FaceCount / 2) - 2, (Balls.Clean.FaceCount / 2) + 1);
        Assert.Equal(Balls.ElementCount, UnseenOracle.CountComponents(mesh));
        Assert.Equal(0, UnseenOracle.DirectedEdges(mesh).Select(edge => (Math.Min(edge.From, edge.To), Math.Max(edge.From, edge.To)))
            .CountBy(edge => edge).Count(edge => edge.Value != 2));
        // Balls of 320 faces: their edges are a tenth of a diagonal or longer.
        Assert.InRange(Grader.CompareSurfaces(mesh, Balls, 0).LargestDistance, 1e-6, 0.1);
    }

    [Fact]
    public void Welded_OfTouchingElements_HasFewerVerticesAndTheSamePlaces()
    {
        var touching = Enumerable.Range(0, 20).Select(seed => UnseenFractals.Create(FractalKind.EqualMaps, seed, 500))
            .Where(new Damage(DamageKind.Welded).IsMeaningful).ToArray();
        Assert.NotEmpty(touching);
        Assert.All(touching, input =>
        {
            var mesh = new Damage(DamageKind.Welded).Apply(input, 1).Mesh;
            Assert.InRange(mesh.VertexCount, 1, input.Clean.VertexCount - 1);
            Assert.InRange(mesh.FaceCount, 1, input.Clean.FaceCount);
            Assert.True(Grader.Compare(mesh, input, 1e-9 * input.Clean.Bounds.Diagonal).IsFound);
        });
    }

    [Fact]
    public void IsMeaningful_OfDamagesThatLeaveTooLittleOrNothingToDo_IsFalse()
    {
        Assert.False(new Damage(DamageKind.Decimated, 0.5).IsMeaningful(Boxes));
        Assert.True(new Damage(DamageKind.Decimated, 0.5).IsMeaningful(Balls));
        Assert.False(new Damage(DamageKind.FlippedEdges, 0.5).IsMeaningful(Balls));
        Assert.True(new Damage(DamageKind.FlippedEdges, 0.5).IsMeaningful(Boxes));
        Assert.False(new Damage(DamageKind.Missing, 0.9).IsMeaningful(Balls));
        Assert.False(new Damage(DamageKind.Noise, 1).IsMeaningful(Tree));
        Assert.All(Damage.All, damage => Assert.InRange(damage.Tolerance(Tree), 1e-4 * Tree.SmallestElement, Tree.SmallestElement));
    }

    private static UnseenInput WithBaseOf(BaseKind kind, int faces) => Enumerable.Range(0, 100)
        .Select(seed => UnseenFractals.Create(FractalKind.Leaves, seed, faces))
        .First(input => input.Description.Contains($"on {kind};", StringComparison.Ordinal));
}
