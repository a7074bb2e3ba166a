using FractalEngine.Core.Colliders;
using FractalEngine.Core.Generation;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Geometry.Simplification;
using FractalEngine.Core.Geometry.Surfaces;
using FractalEngine.Core.Maths;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Geometry.Simplification;

public sealed class QuadricSimplifierTests
{
    // Rounding of some thousand collapses, in the unit of shapes of size 1.
    private const double Rounding = 1e-9;

    [Theory]
    [InlineData(100)]
    [InlineData(2)]
    public void Simplify_FlatGrid_StaysTheSameRectangle(int maxFaces)
    {
        var result = QuadricSimplifier.Simplify(CreateGrid(100, 50, static (_, _) => 0), maxFaces);
        // What lies in the plane, within the rectangle, and has its area without overlaps, is the rectangle.
        Assert.InRange(result.FaceCount, 2, maxFaces);
        Assert.Equal(new(Vector.Zero, new(100, 0, 50)), result.Bounds);
        Near.Equal(5000, result.SurfaceArea(), 5000 * Rounding);
        Assert.All(Faces(result), face => Assert.True(Normal(face).Y < 0));
    }

    [Fact]
    public void Simplify_FinelyDividedBox_BecomesTwelveFaces()
    {
        var box = CreateDividedBox(20);
        Assert.Equal(4800, box.FaceCount);
        var result = QuadricSimplifier.Simplify(box, 12);
        Assert.Equal((12, 8), (result.FaceCount, result.VertexCount));
        Assert.Equal(box.Bounds, result.Bounds);
        Near.Equal(8000, Volume(result), 8000 * Rounding);
        AssertClosedManifold(result, 2);
    }

    [Fact]
    public void Simplify_Sphere_StaysWithinTheSagittaOfItsFaces()
    {
        var sphere = MeshGenerators.Create("icosphere", 0, 20_480);
        var result = QuadricSimplifier.Simplify(sphere, 500);
        // A regular face of n has its corners at the distance r of its middle, with r² = 16π/(3·√3·n), and the sphere rises above it by
        // r²/2. Real faces are less regular than that.
        var sagitta = 8 * Math.PI / (3 * Math.Sqrt(3) * 500);
        var farthest = Distances(sphere, result).Max();
        Assert.True(farthest < 1.5 * sagitta, FormattableString.Invariant($"{farthest / sagitta} sagittas"));
        Assert.Equal(500, result.FaceCount);
        AssertClosedManifold(result, 2);
    }

    [Theory]
    [InlineData("torus-knot", 20_000, 2000, 0)]
    [InlineData("torus-knot", 20_000, 400, 0)]
    [InlineData("icosphere", 1280, 20, 2)]
    public void Simplify_ClosedManifold_StaysOneOfTheSameTopology(string generator, int faces, int maxFaces, int eulerNumber)
    {
        var result = QuadricSimplifier.Simplify(MeshGenerators.Create(generator, 0, faces), maxFaces);
        Assert.Equal(maxFaces, result.FaceCount);
        AssertClosedManifold(result, eulerNumber);
        Assert.True(ClosedSurface.IsSolid(result));
    }

    [Fact]
    public void Simplify_OpenSurface_KeepsItsOutline()
    {
        var hills = CreateGrid(60, 60, static (x, z) => Math.Sin(Math.PI * x / 60) * Math.Sin(Math.PI * z / 60) * 20 * Math.Sin(0.2 * x));
        var result = QuadricSimplifier.Simplify(hills, 300);
        Assert.Equal(300, result.FaceCount);
        // The border is straight, and flat at the height 0. The slopes beside it may pull it by a part of one of its 240 edges.
        var border = BorderEdges(result).ToArray();
        Assert.All(border, edge => Assert.All(new[] { edge.From, edge.To }, point =>
        {
            Near.Equal(0, Math.Min(Math.Min(point.X, 60 - point.X), Math.Min(point.Z, 60 - point.Z)), 0.2);
            Near.Equal(0, point.Y, 0.5);
        }));
        Near.Equal(240, border.Sum(edge => (edge.To - edge.From).Length()), 1);
        Assert.True(Distances(hills, result).Max() < 1.5);
    }

    [Fact]
    public void Simplify_WithAFarOutlier_KeepsTheRest()
    {
        var grid = CreateGrid(40, 40, static (x, z) => 3 * Math.Sin(0.2 * x) * Math.Cos(0.2 * z));
        var mesh = new Mesh([.. grid.Positions, 1e14, 1e14, 1e14], [.. grid.VertexIndices, 0, 1, grid.VertexCount]);
        var result = QuadricSimplifier.Simplify(mesh, 400);
        Assert.Equal(400, result.FaceCount);
        Assert.Equal(1e14, result.Bounds.Maximum.X);
        Assert.Equal((Vector.Zero, grid.Vertex(1), new(1e14, 1e14, 1e14)), Faces(result).Last());
        // Heights of the grid go from −3 to 3.
        Assert.True(DistancesFrom(grid, result).Average() < 0.05);
    }

    [Fact]
    public void Simplify_RandomMeshes_GivesUsedVerticesAndNoMoreFaces() => Seeded.Run(600, random =>
    {
        var mesh = RandomMeshes.Create(random);
        var maxFaces = random.Next(0, Math.Max(1, mesh.FaceCount));
        var result = QuadricSimplifier.Simplify(mesh, maxFaces);
        // That all coordinates are finite is a promise of Mesh.
        Assert.InRange(result.FaceCount, 0, maxFaces);
        Assert.Equal(result.VertexCount, result.VertexIndices.Distinct().Count());
        Assert.Equal(result.VertexCount, VertexWelding.FindRepresentatives(result).Length);
        Assert.Equal(Bits.Of(result), Bits.Of(QuadricSimplifier.Simplify(mesh, maxFaces)));
    });

    [Theory]
    [InlineData(1e308)]
    [InlineData(1e150)]
    [InlineData(1e-150)]
    [InlineData(1e-300)]
    public void Simplify_AtTheEndsOfTheRange_IsTheScaledResult(double size)
    {
        var factor = Math.ScaleB(1, Math.ILogB(size));
        var torus = MeshGenerators.Create("torus-knot", 0, 2000);
        var half = torus.Transform(v => v / Math.ScaleB(1, 1 + Math.ILogB(torus.Bounds.MaxAbsCoordinate())));
        var expected = QuadricSimplifier.Simplify(half, 300).Transform(v => factor * v);
        Assert.Equal(expected, QuadricSimplifier.Simplify(half.Transform(v => factor * v), 300));
    }

    [Fact]
    public void Simplify_WithoutArea_GivesAMesh()
    {
        Assert.Equal(Mesh.Empty, QuadricSimplifier.Simplify(Mesh.Empty, 10));
        Assert.Equal(Mesh.Empty, QuadricSimplifier.Simplify(new([0, 0, 0, 0, 0, 0], []), 10));
        // All at one point: no face has three different vertices.
        Assert.Equal(Mesh.Empty, QuadricSimplifier.Simplify(new([1, 1, 1, 1, 1, 1, 1, 1, 1], [0, 1, 2, 0, 0, 1]), 10));
        double[] line = [.. Enumerable.Range(0, 300).SelectMany(i => new double[] { i, 2 * i, -i })];
        var faces = Enumerable.Range(0, 298).SelectMany(i => new[] { i, i + 1, i + 2 });
        var result = QuadricSimplifier.Simplify(new([.. line], [.. faces]), 20);
        Assert.InRange(result.FaceCount, 0, 20);
        Assert.Equal(0, result.SurfaceArea());
    }

    [Fact]
    public void Simplify_RepeatedFaces_IsAsWithoutThem()
    {
        var once = MeshGenerators.Create("torus-knot", 0, 2000);
        double[] corners = [.. once.VertexIndices.Select(once.Vertex).SelectMany(v => new[] { v.X, v.Y, v.Z })];
        // Each face has vertices of its own here, stands there as it is, turned round, and the other way.
        int[] repeated = [.. Enumerable.Range(0, 2000).SelectMany(face => new[] { 0, 1, 2, 1, 2, 0, 0, 2, 1 }.Select(i => (3 * face) + i))];
        var result = QuadricSimplifier.Simplify(new([.. corners], [.. repeated]), 500);
        Assert.Equal(QuadricSimplifier.Simplify(new([.. corners], [.. Enumerable.Range(0, 6000)]), 500), result);
        AssertClosedManifold(result, 0);
    }

    [Fact]
    public void Simplify_SeparateTriangles_KeepsTheLargest()
    {
        var random = new Random(1);
        List<double> corners = [];
        for (var i = 0; i < 1000; i++)
        {
            // A tenth of them is a hundred times as large as the others.
            var (centre, size) = (random.Vector(100), i % 10 == 0 ? 1 : 0.01);
            foreach (var corner in new[] { Vector.I, Vector.J, Vector.K })
            {
                var (x, y, z) = centre + (size * corner);
                corners.AddRange([x, y, z]);
            }
        }

        var result = QuadricSimplifier.Simplify(new([.. corners], [.. Enumerable.Range(0, 3000)]), 100);
        Assert.Equal(100, result.FaceCount);
        Assert.All(Faces(result), face => Near.Equal(Math.Sqrt(3), Normal(face).Length(), 1e-9));
        Assert.Equal(7, QuadricSimplifier.Simplify(result, 7).FaceCount);
        Assert.Equal(Mesh.Empty, QuadricSimplifier.Simplify(result, 0));
    }

    [Fact]
    public void Simplify_LargeShapeAmongDust_LosesTheDustFirst()
    {
        var sphere = MeshGenerators.Create("icosphere", 0, 5120);
        List<double> positions = [.. sphere.Positions];
        List<int> indices = [.. sphere.VertexIndices];
        Seeded.Run(500, random =>
        {
            var (dust, centre) = (Samples.Tetrahedron, random.Vector(2));
            indices.AddRange(dust.VertexIndices.Select(vertex => vertex + (positions.Count / 3)));
            positions.AddRange(dust.Transform(v => centre + (1e-3 * v)).Positions);
        });
        var result = QuadricSimplifier.Simplify(new([.. positions], [.. indices]), 500);
        // A sagitta of 500 faces is 0.0097 of the radius; the dust may keep some of them.
        Assert.True(Distances(sphere, result).Max() < 0.03);
    }

    [Fact]
    public void Simplify_SheetsAtOneEdge_AreKeptAndReduced()
    {
        var sheet = CreateGrid(20, 20, static (_, _) => 0);
        Func<Vector, Vector>[] turns = [v => v, v => new(v.X, v.Z, 0), v => new(v.X, -v.Z, -v.Z)];
        var sheets = turns.Select(sheet.Transform).ToArray();
        var book = new Mesh(
            [.. sheets.SelectMany(page => page.Positions)],
            [.. sheets.SelectMany((page, i) => page.VertexIndices.Select(vertex => vertex + (i * sheet.VertexCount)))]);
        var result = QuadricSimplifier.Simplify(book, 6);
        Assert.Equal(6, result.FaceCount);
        Near.Equal(book.SurfaceArea(), result.SurfaceArea(), book.SurfaceArea() * Rounding);
        Assert.True(Distances(book, result).Max() < 20 * Rounding);
    }

    [Fact]
    public void Simplify_Hub_TakesNoTimeOfItsOwn()
    {
        // Where each collapse at the rim of this cone went through all faces at its tip, this would take minutes.
        const int Count = 50_000;
        var angles = Enumerable.Range(0, Count).Select(i => Math.Tau * i / Count);
        double[] rim = [.. angles.SelectMany(angle => new[] { Math.Cos(angle), Math.Sin(angle), 0 })];
        int[] indices = [.. Enumerable.Range(0, Count).SelectMany(i => new[] { i, (i + 1) % Count, Count })];
        var result = QuadricSimplifier.Simplify(new([.. rim, 0, 0, 0.5], [.. indices]), 100);
        Assert.InRange(result.FaceCount, 90, 100);
        Assert.Equal(0.5, result.Bounds.Maximum.Z, 1e-3);
    }

    [Fact]
    public void Simplify_WithEnoughFaces_ChangesNoBit()
    {
        var cube = Shapes.Cube();
        Assert.Equal(new Mesh(cube.Positions, cube.VertexIndices), QuadricSimplifier.Simplify(cube, 12));
        // A flat surface loses nothing by moving no vertex: those that are left are some of those that were.
        var grid = CreateGrid(10, 10, static (_, _) => 0.1);
        var vertices = Enumerable.Range(0, grid.VertexCount).Select(grid.Vertex).ToHashSet();
        var result = QuadricSimplifier.Simplify(grid, 40);
        Assert.All(Enumerable.Range(0, result.VertexCount), vertex => Assert.Contains(result.Vertex(vertex), vertices));
    }

    [Fact]
    public void Simplify_WithAttributes_DropsThem()
    {
        var plain = MeshGenerators.Create("icosphere", 0, 320);
        var mesh = NormalGenerator.Generate(new(plain.Positions, plain.VertexIndices)).WithColours(plain.Positions)
            .WithGroups([new(0, 320, "all", "", "", 0)], ["a.mtl"]);
        var result = QuadricSimplifier.Simplify(mesh, 100);
        Assert.Equal(new(result.Positions, result.VertexIndices), result);
    }

    [Fact]
    public void Simplify_WrongArgumentsOrCancelled_Throws()
    {
        var mesh = Shapes.Cube();
        Assert.Throws<ArgumentNullException>(() => QuadricSimplifier.Simplify(null!, 1));
        Assert.Throws<ArgumentOutOfRangeException>(() => QuadricSimplifier.Simplify(mesh, -1));
        Assert.Throws<OperationCanceledException>(() => QuadricSimplifier.Simplify(mesh, 6, new(canceled: true)));
    }

    /// <summary>Creates a surface over the rectangle from (0, 0) to (columns, rows) in x and z, of squares that are cut once.</summary>
    private static Mesh CreateGrid(int columns, int rows, Func<double, double, double> height)
    {
        List<double> positions = [];
        List<int> indices = [];
        for (var row = 0; row <= rows; row++)
        {
            for (var column = 0; column <= columns; column++)
            {
                positions.AddRange([column, height(column, row), row]);
                if (row < rows && column < columns)
                {
                    var a = (row * (columns + 1)) + column;
                    var (b, c, d) = (a + 1, a + columns + 1, a + columns + 2);
                    indices.AddRange([a, b, d, a, d, c]);
                }
            }
        }

        return new([.. positions], [.. indices]);
    }

    /// <summary>Creates a cube of six grids, wound outwards, whose edges have equal vertices.</summary>
    private static Mesh CreateDividedBox(int divisions)
    {
        var grid = CreateGrid(divisions, divisions, static (_, _) => 0);
        Func<Vector, Vector>[] sides =
        [
            v => v, v => new(v.Z, divisions, v.X),
            v => new(v.Z, v.X, 0), v => new(v.X, v.Z, divisions),
            v => new(0, v.Z, v.X), v => new(divisions, v.X, v.Z),
        ];
        var meshes = sides.Select(grid.Transform).ToArray();
        return new(
            [.. meshes.SelectMany(side => side.Positions)],
            [.. meshes.SelectMany((side, i) => side.VertexIndices.Select(vertex => vertex + (i * grid.VertexCount)))]);
    }

    private static IEnumerable<(Vector A, Vector B, Vector C)> Faces(Mesh mesh) => Enumerable.Range(0, mesh.FaceCount).Select(mesh.Face);

    private static Vector Normal((Vector A, Vector B, Vector C) face) => Vector.Cross(face.B - face.A, face.C - face.A);

    private static double Volume(Mesh mesh) => Faces(mesh).Sum(face => Vector.Dot(face.A, Vector.Cross(face.B, face.C))) / 6;

    private static IEnumerable<(int From, int To)> Edges(Mesh mesh) => Enumerable.Range(0, mesh.VertexIndices.Length)
        .Select(i => (mesh.VertexIndices[i], mesh.VertexIndices[i % 3 == 2 ? i - 2 : i + 1]));

    private static IEnumerable<(Vector From, Vector To)> BorderEdges(Mesh mesh)
    {
        var edges = Edges(mesh).ToHashSet();
        return edges.Where(edge => !edges.Contains((edge.To, edge.From))).Select(edge => (mesh.Vertex(edge.From), mesh.Vertex(edge.To)));
    }

    /// <summary>Tests that each edge is passed once in each direction, and that the Euler number V − E + F is as it should be.</summary>
    private static void AssertClosedManifold(Mesh mesh, int eulerNumber)
    {
        var edges = Edges(mesh).ToArray();
        Assert.Equal(edges.Length, edges.Distinct().Count());
        Assert.Empty(BorderEdges(mesh));
        Assert.Equal(eulerNumber, mesh.VertexCount - (edges.Length / 2) + mesh.FaceCount);
    }

    /// <summary>Distances between two surfaces: of the vertices and centres of each from the other.</summary>
    private static double[] Distances(Mesh mesh1, Mesh mesh2) => [.. DistancesFrom(mesh1, mesh2), .. DistancesFrom(mesh2, mesh1)];

    private static IEnumerable<double> DistancesFrom(Mesh mesh, Mesh other)
    {
        var collider = Collider.For(other);
        return Faces(mesh).SelectMany(face => new[] { face.A, face.B, face.C, (face.A + face.B + face.C) / 3 })
            .Select(point => collider.FindClosest(point).Distance);
    }
}
