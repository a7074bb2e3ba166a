using FractalEngine.Benchmarks.Measuring;
using FractalEngine.Core.Colliders;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Generation;
using FractalEngine.Core.Geometry;

namespace FractalEngine.Benchmarks.Growth;

/// <summary>
/// How does the cost of a query near the surface grow with the faces of a base mesh, for a fractal over it and for the mesh itself?
/// </summary>
internal static class GrowthByFaces
{
    private const int Depth = 5;

    // Colliders that test every face of the base are queried at fewer positions.
    private const int MaxFaceTests = 4_000_000;

    /// <summary>Measures and writes all rows of the table.</summary>
    public static void Write(TableOptions options)
    {
        (string Name, int[] Faces)[] cases =
        [
            ("terrain", [1, 2, 10, 32, 100, 316, 1000, 3162, 10_000, 31_623, 100_000]),
            ("icosphere", [20, 80, 320, 1280, 5120, 20_480, 81_920]),
        ];
        var queries = options.IsQuick ? 256 : 1024;
        var points = (from item in cases from faces in item.Faces select new DataPoint(item.Name, faces, queries)).ToArray();
        var times = InterleavedTiming.MeasureBestSeconds([.. points.SelectMany(point => point.Actions)], options.Rounds);
        var table = options.CreateTable(
            "growth-faces.csv", "base", "base_faces", "fractal_exact_us", "fractal_greedy_us", "mesh_hierarchy_us", "mesh_simple_us",
            "fractal_exact_face_tests", "fractal_greedy_face_tests", "mesh_hierarchy_face_tests", "fractal_exact_bound_tests",
            "mesh_hierarchy_bound_tests", "fractal_exact_bytes", "mesh_hierarchy_bytes", "fractal_exact_build_ms",
            "mesh_hierarchy_build_ms");
        foreach (var (point, i) in points.Select((point, i) => (point, 6 * i)))
        {
            var (exact, greedy, hierarchy, simple) = (point.Exact, point.Greedy, point.Hierarchy, point.Simple);
            table.Add(
                point.Name, point.Mesh.FaceCount, exact.MicrosecondsPerQuery, greedy.MicrosecondsPerQuery, hierarchy.MicrosecondsPerQuery,
                simple.MicrosecondsPerQuery, exact.FaceTests, greedy.FaceTests, hierarchy.FaceTests, exact.BoundTests, hierarchy.BoundTests,
                exact.StorageBytes, hierarchy.StorageBytes, Math.Round(1e3 * times[i + 4], 4), Math.Round(1e3 * times[i + 5], 4));
        }

        table.Save();
    }

    private sealed class DataPoint
    {
        private readonly Fractal _fractal;

        public DataPoint(string name, int faces, int queries)
        {
            Name = name;
            Mesh = CreateBaseMesh(name, faces);
            _fractal = new(FractalCase.Load("sierpinski", Depth).Fractal.Description, Mesh);
            var random = new Random(1);
            var onFractal = Enumerable.Range(0, queries).Select(_ => QueryPositions.NearSurface(random, _fractal)).ToArray();
            var onMesh = Enumerable.Range(0, queries).Select(_ => QueryPositions.NearSurface(random, Mesh)).ToArray();
            Exact = new(new ExactFractalCollider(_fractal), onFractal);
            Hierarchy = new(new HierarchyCollider(Mesh), onMesh);
            Greedy = new(new FractalCollider(_fractal), onFractal[..Math.Clamp(MaxFaceTests / (35 * faces), 1, queries)]);
            Simple = new(new SimpleCollider(Mesh), onMesh[..Math.Clamp(MaxFaceTests / faces, 1, queries)]);
        }

        public string Name { get; }

        public Mesh Mesh { get; }

        public ColliderWorkload Exact { get; }

        public ColliderWorkload Greedy { get; }

        public ColliderWorkload Hierarchy { get; }

        public ColliderWorkload Simple { get; }

        public Action[] Actions =>
        [
            Exact.RunQueries, Greedy.RunQueries, Hierarchy.RunQueries, Simple.RunQueries,
            () => _ = new ExactFractalCollider(FractalCase.Copy(_fractal)),
            () => _ = new HierarchyCollider(Mesh),
        ];
    }

    /// <summary>
    /// Creates a generated mesh in a box of side 2, like that of the fractal's own base. A mesh of one face is a triangle.
    /// </summary>
    private static Mesh CreateBaseMesh(string name, int faces)
    {
        var mesh = faces == 1 ? new Mesh([-1, 0, -1, 1, 0, -1, 0, 0, 1], [0, 2, 1]) : MeshGenerators.Create(name, 1, faces);
        var (centre, scale) = (mesh.Bounds.Centre, 2 / mesh.Bounds.Size.MaxAbsComponent());
        var positions = Enumerable.Range(0, mesh.VertexCount).Select(mesh.Vertex).Select(vertex => scale * (vertex - centre));
        return new([.. positions.SelectMany(static vertex => (double[])[vertex.X, vertex.Y, vertex.Z])], mesh.VertexIndices);
    }
}
