using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Fractals.Graphs;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Geometry.Triangles;
using FractalEngine.Core.Maths;

namespace FractalEngine.Tests.Fractals.Levels.Building;

/// <summary>All chains of a graph, found by following each map. It shares nothing with hierarchies, counts and expansions.</summary>
internal sealed class ExpandedGraph
{
    private readonly FractalGraph _graph;
    private readonly int _maxInstances;
    private readonly List<Instance> _instances = [];
    private readonly List<(Vector A, Vector B, Vector C)> _faces = [];

    /// <summary>Follows all chains, unless they are too many.</summary>
    public ExpandedGraph(FractalGraph graph, int maxInstances = 200_000)
    {
        _graph = graph;
        _maxInstances = maxInstances;
        AddPart(graph.BaseMeshes.Length + graph.Parts.Length - 1, AffineMap.Identity, []);
        foreach (var (mesh, map, _) in _instances)
        {
            _faces.AddRange(FacesOf(mesh, map));
        }
    }

    public IReadOnlyList<Instance> Instances => _instances;

    public bool IsTooLarge { get; private set; }

    public int FaceCount => _faces.Count;

    public BoundingBox Box
    {
        get
        {
            var box = BoundingBox.Empty;
            foreach (var (a, b, c) in _faces)
            {
                box = box.Including(a).Including(b).Including(c);
            }

            return box;
        }
    }

    /// <summary>The distances of all faces from a position.</summary>
    public double[] Distances(Vector position) => [.. _faces.Select(face => Distance(face, position))];

    /// <summary>The triangle that a result names.</summary>
    public (Vector A, Vector B, Vector C) FaceOf(ReadOnlySpan<int> path, int face)
    {
        foreach (var (mesh, map, instancePath) in _instances)
        {
            if (path.SequenceEqual(instancePath))
            {
                var (a, b, c) = mesh.Face(face);
                return (map * a, map * b, map * c);
            }
        }

        throw new KeyNotFoundException($"no instance has the path {string.Join(' ', path.ToArray())}");
    }

    /// <summary>The instances of which no two have the same image of the same mesh, to a tolerance.</summary>
    public List<Instance> Distinct(double tolerance)
    {
        // Only those that are next to each other along a line are compared.
        Vector direction = new(0.61, 0.53, 0.59);
        var sorted = _instances.Where(instance => instance.Mesh.FaceCount > 0)
            .Select(instance => (Place: Vector.Dot(direction, instance.Map * instance.Mesh.Vertex(0)), Instance: instance))
            .OrderBy(item => item.Place).ToArray();
        List<(double Place, Instance Instance)> distinct = [];
        foreach (var item in sorted)
        {
            var isNew = true;
            for (var i = distinct.Count - 1; i >= 0 && distinct[i].Place >= item.Place - (2 * tolerance) && isNew; i--)
            {
                isNew = !AreSame(distinct[i].Instance, item.Instance, tolerance);
            }

            if (isNew)
            {
                distinct.Add(item);
            }
        }

        return [.. distinct.Select(item => item.Instance)];
    }

    public static double[] Distances(IEnumerable<Instance> instances, Vector position) =>
        [.. instances.SelectMany(instance => FacesOf(instance.Mesh, instance.Map)).Select(face => Distance(face, position))];

    /// <summary>Makes one mesh of the faces of all instances.</summary>
    public Mesh Flatten() => new(
        [.. _faces.SelectMany(face => new[] { face.A, face.B, face.C }).SelectMany(v => new[] { v.X, v.Y, v.Z })],
        [.. Enumerable.Range(0, 3 * _faces.Count)]);

    private static bool AreSame(Instance instance, Instance other, double tolerance) =>
        ReferenceEquals(instance.Mesh, other.Mesh) && Enumerable.Range(0, instance.Mesh.VertexCount).All(vertex =>
            ((instance.Map * instance.Mesh.Vertex(vertex)) - (other.Map * instance.Mesh.Vertex(vertex))).MaxAbsComponent() <= tolerance);

    private static double Distance((Vector A, Vector B, Vector C) face, Vector position) =>
        Math.Sqrt(TriangleKernel.ClosestPoint(position, face.A, face.B, face.C).DistanceSquared);

    private static IEnumerable<(Vector A, Vector B, Vector C)> FacesOf(Mesh mesh, AffineMap map)
    {
        for (var face = 0; face < mesh.FaceCount; face++)
        {
            var (a, b, c) = mesh.Face(face);
            yield return (map * a, map * b, map * c);
        }
    }

    private static IEnumerable<TransformationSet> SetsOf(IEnumerable<FractalStep> steps) => steps.SelectMany(static step => step switch
    {
        Repetition repetition => Enumerable.Range(0, repetition.Count!.Value).SelectMany(_ => SetsOf(repetition.Round)),
        TransformationSet set => [set],
        _ => throw new ArgumentException("no step", nameof(steps)),
    });

    private void AddPart(int index, AffineMap map, int[] path)
    {
        IsTooLarge |= _instances.Count > _maxInstances;
        if (IsTooLarge)
        {
            return;
        }

        if (index < _graph.BaseMeshes.Length)
        {
            _instances.Add(new(_graph.BaseMeshes[index], map, path));
        }
        else if (_graph.Parts[index - _graph.BaseMeshes.Length] is SteppedPart stepped)
        {
            AddSteps([.. SetsOf(stepped.Steps)], 0, stepped.Inner, map, path);
        }
        else if (_graph.Parts[index - _graph.BaseMeshes.Length] is RecursivePart part)
        {
            AddRecursive(part, part.Root, part.Levels!.Value, map, path);
        }
    }

    private void AddSteps(TransformationSet[] sets, int first, int inner, AffineMap map, int[] path)
    {
        if (first == sets.Length)
        {
            AddPart(inner, map, path);
            return;
        }

        for (var i = 0; i < sets[first].Maps.Length && !IsTooLarge; i++)
        {
            AddSteps(sets, first + 1, inner, map * sets[first].Maps[i], [.. path, i]);
        }
    }

    private void AddRecursive(RecursivePart part, int recursive, int levels, AffineMap map, int[] path)
    {
        if (levels <= 0)
        {
            AddPart(part.Recursives[recursive].BasePart, map, path);
            return;
        }

        foreach (var (i, call) in part.Recursives[recursive].Calls.Index())
        {
            if (IsTooLarge)
            {
                return;
            }

            if (call.LevelsLess is { } less)
            {
                AddRecursive(part, call.Target, levels - less, map * call.Map, [.. path, i]);
            }
            else
            {
                AddPart(call.Target, map * call.Map, [.. path, i]);
            }
        }
    }

    /// <summary>An instance of a base mesh.</summary>
    /// <param name="Mesh">The base mesh.</param>
    /// <param name="Map">From its frame to that of the whole.</param>
    /// <param name="Path">Indices of the maps that lead to it, in their sets and calls.</param>
    internal readonly record struct Instance(Mesh Mesh, AffineMap Map, int[] Path);
}
