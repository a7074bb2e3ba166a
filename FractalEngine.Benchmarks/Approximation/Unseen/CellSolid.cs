using System.Collections.Immutable;
using FractalEngine.Core.Maths;

namespace FractalEngine.Benchmarks.Approximation.Unseen;

/// <summary>The surface of a solid that consists of cells of an uneven grid, with vertices that its sides share.</summary>
/// <param name="X">Where cells begin and end along x, ascending.</param>
/// <param name="Y">Where cells begin and end along y, ascending.</param>
/// <param name="Z">Where cells begin and end along z, ascending.</param>
/// <param name="IsSolid">Tells whether the cell of three indices is part of the solid.</param>
/// <param name="UnitOf">Returns the index of the unit that a cell belongs to.</param>
internal sealed record CellSolid(
    ImmutableArray<double> X, ImmutableArray<double> Y, ImmutableArray<double> Z,
    Func<int, int, int, bool> IsSolid, Func<int, int, int, int> UnitOf)
{
    /// <summary>Puts intervals one after the other, and returns their ends.</summary>
    public static ImmutableArray<double> Sums(IEnumerable<double> lengths)
    {
        var (sums, sum) = (ImmutableArray.CreateBuilder<double>(), 0.0);
        sums.Add(0);
        foreach (var length in lengths)
        {
            sum += length;
            sums.Add(sum);
        }

        return sums.ToImmutable();
    }

    /// <summary>Makes the input of a solid: its units are elements, and the one with most faces, the first of these, is the base.</summary>
    public UnseenInput ToInput(AffineMap frame, string kind, int seed, string formula, ImmutableArray<Generator> generators)
    {
        var facesOf = new SortedDictionary<int, List<int>>();
        var (vertices, positions) = (new Dictionary<(int, int, int), int>(), new List<Vector>());
        for (var i = 0; i < X.Length - 1; i++)
        {
            for (var j = 0; j < Y.Length - 1; j++)
            {
                for (var k = 0; k < Z.Length - 1; k++)
                {
                    if (Has(i, j, k))
                    {
                        AddSides(i, j, k);
                    }
                }
            }
        }

        // The units at the corners of the grid; a hole at a corner belongs to none.
        var corners = new SortedSet<int>();
        for (var corner = 0; corner < 8; corner++)
        {
            corners.Add(UnitOf(
                (corner & 1) * (X.Length - 2), ((corner >> 1) & 1) * (Y.Length - 2), (corner >> 2) * (Z.Length - 2)));
        }

        var units = facesOf.Keys.ToArray();
        var ends = corners.Select(unit => Array.IndexOf(units, unit)).Where(index => index >= 0);
        var (elements, indices) = (ImmutableArray.CreateBuilder<UnseenElement>(), new List<int>());
        foreach (var faces in facesOf.Values)
        {
            elements.Add(new(indices.Count / 3, faces.Count / 3, 0));
            indices.AddRange(faces);
        }

        var clean = MeshTools.Create([.. positions.Select(position => frame * position)], indices);
        var largest = facesOf.Values.MaxBy(faces => faces.Count)!;
        var inverse = frame.Inverse();
        return new(
            kind, seed, FormattableString.Invariant($"{kind} {seed}: {formula}; {elements.Count} elements, {clean.FaceCount} faces"),
            clean, clean, elements.ToImmutable(), [MeshTools.TakeFaces(MeshTools.Positions(clean), largest)], [.. ends],
            [.. generators.Select(generator => generator with { Map = frame * generator.Map * inverse })], 1, 0);

        void AddSides(int i, int j, int k)
        {
            var unit = UnitOf(i, j, k);
            if (!facesOf.TryGetValue(unit, out var faces))
            {
                facesOf.Add(unit, faces = []);
            }

            // Corners around each side, seen from outside in a right-handed frame.
            AddSide(Has(i - 1, j, k), (i, j, k), (i, j, k + 1), (i, j + 1, k + 1), (i, j + 1, k));
            AddSide(Has(i + 1, j, k), (i + 1, j, k), (i + 1, j + 1, k), (i + 1, j + 1, k + 1), (i + 1, j, k + 1));
            AddSide(Has(i, j - 1, k), (i, j, k), (i + 1, j, k), (i + 1, j, k + 1), (i, j, k + 1));
            AddSide(Has(i, j + 1, k), (i, j + 1, k), (i, j + 1, k + 1), (i + 1, j + 1, k + 1), (i + 1, j + 1, k));
            AddSide(Has(i, j, k - 1), (i, j, k), (i, j + 1, k), (i + 1, j + 1, k), (i + 1, j, k));
            AddSide(Has(i, j, k + 1), (i, j, k + 1), (i + 1, j, k + 1), (i + 1, j + 1, k + 1), (i, j + 1, k + 1));

            void AddSide(bool isHidden, (int, int, int) a, (int, int, int) b, (int, int, int) c, (int, int, int) d)
            {
                if (!isHidden)
                {
                    faces.AddRange([Vertex(a), Vertex(b), Vertex(c), Vertex(a), Vertex(c), Vertex(d)]);
                }
            }
        }

        int Vertex((int I, int J, int K) corner)
        {
            if (!vertices.TryGetValue(corner, out var vertex))
            {
                vertex = positions.Count;
                positions.Add(new(X[corner.I], Y[corner.J], Z[corner.K]));
                vertices.Add(corner, vertex);
            }

            return vertex;
        }
    }

    private bool Has(int i, int j, int k) =>
        i >= 0 && j >= 0 && k >= 0 && i < X.Length - 1 && j < Y.Length - 1 && k < Z.Length - 1 && IsSolid(i, j, k);
}
