using System.Collections.Immutable;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Benchmarks.Approximation.Unseen;

/// <summary>Expands placed bases to one mesh of elements, of which no two coincide.</summary>
/// <remarks>
/// Two elements coincide where they are images of the same component, and each vertex of one lies on a vertex of the other: closer than
/// 1e-9 of the diagonal of the whole. So a cube that was turned by a quarter coincides with itself, though other diagonals divide its
/// sides.
/// </remarks>
internal sealed class ElementExpansion
{
    /// <summary>How close vertices are that lie at one place, as a part of the diagonal of the model.</summary>
    public const double RelativeTolerance = 1e-9;

    private readonly List<Vector> _positions = [];
    private readonly List<int> _indices = [];
    private readonly List<UnseenElement> _elements = [];
    private readonly List<int> _firstVertices = [];
    private readonly SortedSet<int> _ends = [];
    private readonly ImmutableArray<Mesh> _bases;
    private readonly double _tolerance;
    private readonly PlaceIndex _centres;

    private ElementExpansion(ImmutableArray<Mesh> bases, double tolerance)
    {
        (_bases, _tolerance) = (bases, tolerance);
        _centres = new(tolerance);
    }

    private int CoincidentElements { get; set; }

    /// <summary>Expands a recipe in a frame; <see cref="UnseenInput.Mesh"/> is as clean as <see cref="UnseenInput.Clean"/>.</summary>
    public static UnseenInput Expand(FractalRecipe recipe, AffineMap frame, string kind, int seed, string nameOfBase)
    {
        var bases = recipe.Bases.SelectMany(parts => parts).ToImmutableArray();
        var bounds = BoundingBox.Empty;
        foreach (var (map, index, _) in Elements(recipe))
        {
            bounds = BoundingBox.Union(bounds, bases[index].Bounds.Transform(frame * map));
        }

        var expansion = new ElementExpansion(bases, RelativeTolerance * bounds.Diagonal);
        foreach (var (map, index, isEnd) in Elements(recipe))
        {
            var element = expansion.Add(frame * map, index);
            if (isEnd)
            {
                expansion._ends.Add(element);
            }
        }

        var mesh = MeshTools.Create(expansion._positions, expansion._indices);
        var inverse = frame.Inverse();
        var description = FormattableString.Invariant(
            $"{kind} {seed}: {recipe.Formula}, on {nameOfBase}; {expansion._elements.Count} elements, {mesh.FaceCount} faces");
        return new(
            kind, seed, description, mesh, mesh, [.. expansion._elements],
            [.. bases.Select(part => MeshTools.Move(part, frame))],
            [.. expansion._ends],
            [.. recipe.Generators.Select(generator => generator with { Map = frame * generator.Map * inverse })],
            recipe.Depth, expansion.CoincidentElements);
    }

    /// <summary>Lists the components of all placed bases; the index is that of the component among those of all bases.</summary>
    private static IEnumerable<(AffineMap Map, int Base, bool IsEnd)> Elements(FractalRecipe recipe)
    {
        var first = new int[recipe.Bases.Length];
        for (var i = 1; i < first.Length; i++)
        {
            first[i] = first[i - 1] + recipe.Bases[i - 1].Length;
        }

        var ends = recipe.Ends.ToHashSet();
        for (var i = 0; i < recipe.Placements.Count; i++)
        {
            var (map, index) = recipe.Placements[i];
            for (var part = 0; part < recipe.Bases[index].Length; part++)
            {
                yield return (map, first[index] + part, ends.Contains(i));
            }
        }
    }

    /// <summary>Adds an image of a component, unless an equal one stands there, and returns the index of that element.</summary>
    private int Add(AffineMap map, int index)
    {
        var part = _bases[index];
        var (firstVertex, firstFace) = (_positions.Count, _indices.Count / 3);
        var sum = Vector.Zero;
        for (var vertex = 0; vertex < part.VertexCount; vertex++)
        {
            var position = map * part.Vertex(vertex);
            _positions.Add(position);
            sum += position;
        }

        var centre = sum / part.VertexCount;
        foreach (var candidate in _centres.Near(centre))
        {
            if (_elements[candidate].Base == index && Coincide(_firstVertices[candidate], firstVertex, part.VertexCount))
            {
                _positions.RemoveRange(firstVertex, part.VertexCount);
                CoincidentElements++;
                return candidate;
            }
        }

        _centres.Add(centre, _elements.Count);
        _elements.Add(new(firstFace, part.FaceCount, index));
        _firstVertices.Add(firstVertex);
        // Fronts stay fronts where a map mirrors.
        var isMirrored = map.Linear.Determinant() < 0;
        for (var i = 0; i < part.VertexIndices.Length; i += 3)
        {
            var (a, b, c) = (part.VertexIndices[i], part.VertexIndices[i + 1], part.VertexIndices[i + 2]);
            _indices.AddRange([firstVertex + a, firstVertex + (isMirrored ? c : b), firstVertex + (isMirrored ? b : c)]);
        }

        return _elements.Count - 1;
    }

    private bool Coincide(int first1, int first2, int count)
    {
        for (var i = 0; i < count; i++)
        {
            var position = _positions[first2 + i];
            // Mostly it is the vertex of the same index.
            var isFound = IsAt(first1 + i, position);
            for (var j = 0; j < count && !isFound; j++)
            {
                isFound = IsAt(first1 + j, position);
            }

            if (!isFound)
            {
                return false;
            }
        }

        return true;
    }

    private bool IsAt(int vertex, Vector position) => (_positions[vertex] - position).LengthSquared() <= _tolerance * _tolerance;
}
