using System.Collections.Immutable;
using FractalEngine.Core.Approximation.Damaged.Placements;
using FractalEngine.Core.Approximation.Grammars;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Approximation.Damaged;

/// <summary>Fits maps and base vertices to all elements that a description explains, and makes a grammar of it.</summary>
internal sealed class Refinement(DamagedModel model, CancellationToken cancellation)
{
    private const int Rounds = 4;

    // Tolerance of the first round in units of elements' sizes; each round halves it.
    private const double FirstRelative = 0.3;

    /// <summary>Returns the grammar with fitted numbers.</summary>
    public MeshGrammar Refine(Hypothesis description)
    {
        var relative = FirstRelative;
        for (var round = 0; round < Rounds; round++)
        {
            cancellation.ThrowIfCancellationRequested();
            var found = FindElements(description, relative);
            description = FitMaps(description, found);
            description = FitBases(description, FindElements(description, relative));
            relative /= 2;
        }

        var words = description.Words();
        var meshes = FindElements(description, relative);
        var mesh = MeshOf(description, words, meshes);
        if (description.Depth > 0)
        {
            var maps = description.Sets[0];
            var all = Enumerable.Range(0, maps.Count).ToArray();
            return new([], new(maps, [.. Enumerable.Repeat(all, maps.Count + 1)], description.Depth), mesh, null);
        }

        return new([.. description.Sets.Select(set => new GrammarStep([set], 1))], null, mesh, null);
    }

    /// <summary>For each base and each word the element there, and its symmetry; null where none is.</summary>
    private (PlacedElement Element, int Symmetry)?[,] FindElements(Hypothesis description, double relative)
    {
        var index = model.CreateIndex(relative);
        foreach (var element in model.Elements)
        {
            index.Add(element.Class, element.Placement);
        }

        var words = description.Words();
        var found = new (PlacedElement, int)?[description.Bases.Count, words.Count];
        for (var part = 0; part < description.Bases.Count; part++)
        {
            for (var word = 0; word < words.Count; word++)
            {
                var (elementClass, placement) = description.Bases[part];
                var image = index.Find(elementClass, words[word].Map * placement, out var symmetry, out _);
                found[part, word] = image >= 0 ? (model.Elements[image], symmetry) : null;
            }
        }

        return found;
    }

    private AffineMap PlacementOf((PlacedElement Element, int Symmetry) found) => found.Element.Placement with
    {
        Linear = found.Element.Placement.Linear * model.Templates[found.Element.Class].Symmetries[found.Symmetry].Map,
    };

    private Hypothesis FitMaps(Hypothesis description, (PlacedElement Element, int Symmetry)?[,] found)
    {
        var words = description.Words();
        var wordOf = Enumerable.Range(0, words.Count).ToDictionary(word => string.Join(',', words[word].Letters));
        var fits = description.Sets.ConvertAll(set => set.ConvertAll(_ => new MapFit(model.Centre)));
        for (var word = 0; word < words.Count; word++)
        {
            var letters = words[word].Letters;
            if (description.Depth > 0)
            {
                if (letters.Length > 0)
                {
                    Add(0, letters[0], AffineMap.Identity, wordOf[string.Join(',', letters[1..])], word);
                }

                continue;
            }

            var before = AffineMap.Identity;
            for (var set = 0; set < letters.Length; set++)
            {
                var letter = letters[set];
                if (letter > 0)
                {
                    int[] start = [.. letters[..set], 0, .. letters[(set + 1)..]];
                    Add(set, letter, before, wordOf[string.Join(',', start)], word);
                }

                before *= description.Sets[set][letter];
            }
        }

        return description with
        {
            Sets = [.. description.Sets.Select((set, index) => set.Select(
                (map, letter) => fits[index][letter].Solve(map)).ToList())],
        };

        void Add(int set, int letter, AffineMap before, int from, int to)
        {
            var back = before.Inverse();
            // Noise counts less where the maps before made things smaller.
            var weight = Math.Cbrt(before.Linear.Determinant() * before.Linear.Determinant());
            for (var part = 0; part < description.Bases.Count; part++)
            {
                if (found[part, from] is { } start && found[part, to] is { } end)
                {
                    fits[set][letter].Add(
                        back * PlacementOf(start), back * PlacementOf(end), model.Templates[start.Element.Class].IsFlat, weight);
                }
            }
        }
    }

    private Hypothesis FitBases(Hypothesis description, (PlacedElement Element, int Symmetry)?[,] found)
    {
        var words = description.Words();
        var bases = new List<(int, AffineMap)>();
        for (var part = 0; part < description.Bases.Count; part++)
        {
            var squares = default(Matrix);
            var (centroid, linear) = (Vector.Zero, default(Matrix));
            for (var word = 0; word < words.Count; word++)
            {
                if (found[part, word] is { } element)
                {
                    var map = words[word].Map;
                    var transposed = map.Linear.Transpose();
                    var placement = PlacementOf(element);
                    squares += transposed * map.Linear;
                    centroid += transposed * (placement.Translation - map.Translation);
                    linear += transposed * placement.Linear;
                }
            }

            var inverse = squares.Determinant() > 0 ? squares.Inverse() : Matrix.Identity;
            bases.Add(squares.Determinant() > 0
                ? (description.Bases[part].Class, new(inverse * linear, inverse * centroid)) : description.Bases[part]);
        }

        return description with { Bases = bases };
    }

    /// <summary>The base mesh, with the vertices whose images are nearest to those of all its elements.</summary>
    private Mesh MeshOf(
        Hypothesis description, List<(AffineMap Map, int[] Letters)> words, (PlacedElement Element, int Symmetry)?[,] found)
    {
        var positions = ImmutableArray.CreateBuilder<double>();
        var corners = ImmutableArray.CreateBuilder<int>();
        for (var part = 0; part < description.Bases.Count; part++)
        {
            var template = model.Templates[description.Bases[part].Class];
            var squares = default(Matrix);
            var sums = new Vector[template.VertexCount];
            for (var word = 0; word < words.Count; word++)
            {
                if (found[part, word] is { } element)
                {
                    var transposed = words[word].Map.Linear.Transpose();
                    squares += transposed * words[word].Map.Linear;
                    for (var vertex = 0; vertex < sums.Length; vertex++)
                    {
                        var point = element.Element.Points[template.Symmetries[element.Symmetry].Order[vertex]];
                        sums[vertex] += transposed * (point - words[word].Map.Translation);
                    }
                }
            }

            corners.AddRange(template.Corners.Select(corner => corner + (positions.Count / 3)));
            var inverse = squares.Determinant() > 0 ? squares.Inverse() : Matrix.Identity;
            foreach (var sum in sums)
            {
                var point = inverse * sum;
                positions.AddRange(point.X, point.Y, point.Z);
            }
        }

        return new(positions.ToImmutable(), corners.ToImmutable());
    }
}
