using System.Collections.Immutable;
using FractalEngine.Core.Approximation.Damaged.Placements;
using FractalEngine.Core.Approximation.Grammars;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Approximation.Damaged;

/// <summary>Fits maps and base vertices to all elements that a description explains, and makes a grammar of it.</summary>
internal sealed class Refinement(DamagedModel model, CancellationToken cancellation)
{
    private const int Rounds = 12;

    // After so many rounds elements must be twice as near, if hardly any is lost by that.
    private const int RoundsPerHalf = 3;
    private const double MinKept = 0.98;

    /// <summary>Returns the grammar with fitted numbers.</summary>
    public MeshGrammar Refine(Hypothesis description)
    {
        var relative = model.FirstTolerance;
        for (var round = 0; round < Rounds; round++)
        {
            cancellation.ThrowIfCancellationRequested();
            var found = FindElements(description, relative);
            var first = 0;
            foreach (var count in description.Sets.Select(set => set.Count - 1).Append(description.Tree.Count).ToArray())
            {
                description = FitMaps(description, found, first, count);
                first += count;
            }

            description = FitBases(description, FindElements(description, relative));
            if (round % RoundsPerHalf == 0 && CountOf(FindElements(description, relative / 2)) > MinKept * CountOf(found))
            {
                relative /= 2;
            }
        }

        var all = Enumerable.Range(0, description.Tree.Count).ToArray();
        var tree = all.Length == 0 ? null : new MapTree(
            description.Tree,
            [.. Enumerable.Range(0, all.Length + 1).Select(row => Array.FindAll(all, map => description.Follows?[row, map] ?? true))],
            description.Depth);
        var elements = FindElements(description, relative);
        var baseCount = description.Bases.Count - description.LeafCount;
        return new(
            [.. description.Sets.Select(set => new GrammarStep([set], 1))], tree, MeshOf(description, elements, 0, baseCount),
            description.LeafCount == 0 ? null : MeshOf(description, elements, baseCount, description.LeafCount));
    }

    /// <summary>For each base and each word the element there, and its symmetry; null where none is.</summary>
    private (PlacedElement Element, int Symmetry)?[,] FindElements(Hypothesis description, double relative)
    {
        var index = model.CreateFullIndex(relative);
        var words = description.Words();
        var found = new (PlacedElement, int)?[description.Bases.Count, words.Count];
        for (var part = 0; part < description.Bases.Count; part++)
        {
            for (var word = 0; word < words.Count; word++)
            {
                var (elementClass, placement) = description.Bases[part];
                var symmetry = 0;
                var image = description.Stands(part, words[word].Letters)
                    ? index.Find(elementClass, words[word].Map * placement, out symmetry, out _)
                    : -1;
                found[part, word] = image >= 0 ? (model.Elements[image], symmetry) : null;
            }
        }

        return found;
    }

    private static int CountOf((PlacedElement, int)?[,] found) => found.Cast<(PlacedElement, int)?>().Count(element => element is not null);

    private AffineMap PlacementOf((PlacedElement Element, int Symmetry) found) =>
        PlacedElement.After(model.Templates[found.Element.Class].Symmetries[found.Symmetry].Map, found.Element.Placement);

    /// <summary>
    /// Fits the maps of a set, or of the tree, to the elements of all words with them. What a word is off is shared out to those of its
    /// maps that are fitted, so that they don't all mend it.
    /// </summary>
    private Hypothesis FitMaps(Hypothesis description, (PlacedElement Element, int Symmetry)?[,] found, int first, int count)
    {
        var words = description.Words();
        var maps = description.Maps;
        var fits = maps.ConvertAll(_ => new MapFit(model.Centre));
        for (var word = 0; word < words.Count; word++)
        {
            var letters = words[word].Letters;
            var step = 1.0 / letters.Count(letter => letter >= first && letter < first + count);
            var before = AffineMap.Identity;
            foreach (var letter in letters)
            {
                if (letter >= first && letter < first + count)
                {
                    Add(letter, word, before, step);
                }

                before *= maps[letter];
            }
        }

        return description.WithMaps([.. maps.Zip(fits, (map, fit) => fit.Solve(map))]);

        void Add(int letter, int word, AffineMap before, double step)
        {
            if (!RelationSearch.CanInvert(before) || !RelationSearch.CanInvert(maps[letter]))
            {
                return;
            }

            var back = before.Inverse();
            var after = maps[letter].Inverse() * back * words[word].Map;
            // Noise counts less where the maps before made things smaller.
            var weight = Math.Cbrt(before.Linear.Determinant() * before.Linear.Determinant());
            for (var part = 0; part < description.Bases.Count; part++)
            {
                if (found[part, word] is { } element)
                {
                    var from = after * description.Bases[part].Placement;
                    var (image, to) = (maps[letter] * from, back * PlacementOf(element));
                    fits[letter].Add(
                        from,
                        new(image.Linear + (step * (to.Linear - image.Linear)),
                            image.Translation + (step * (to.Translation - image.Translation))),
                        model.Templates[element.Element.Class].IsFlat, weight);
                }
            }
        }
    }

    /// <summary>Puts each base where its images are nearest to all its elements.</summary>
    private Hypothesis FitBases(Hypothesis description, (PlacedElement Element, int Symmetry)?[,] found) => description with
    {
        Bases = [.. description.Bases.Select((known, part) => (known.Class, PlacementFrom(PointsOf(
            description, found, part, element => CornersOf(PlacementOf(element)), CornersOf(known.Placement)))))],
    };

    private static Vector[] CornersOf(AffineMap placement) =>
        [placement.Translation, placement * Vector.I, placement * Vector.J, placement * Vector.K];

    private static AffineMap PlacementFrom(Vector[] corners) =>
        new(new(corners[1] - corners[0], corners[2] - corners[0], corners[3] - corners[0]), corners[0]);

    /// <summary>The points whose images by all words are nearest to points of the elements there.</summary>
    private static Vector[] PointsOf(
        Hypothesis description, (PlacedElement Element, int Symmetry)?[,] found, int part,
        Func<(PlacedElement Element, int Symmetry), Vector[]> pointsOf, Vector[] known)
    {
        var words = description.Words();
        var squares = default(Matrix);
        var sums = new Vector[known.Length];
        for (var word = 0; word < words.Count; word++)
        {
            if (found[part, word] is { } element)
            {
                var transposed = words[word].Map.Linear.Transpose();
                squares += transposed * words[word].Map.Linear;
                var points = pointsOf(element);
                for (var point = 0; point < sums.Length; point++)
                {
                    sums[point] += transposed * (points[point] - words[word].Map.Translation);
                }
            }
        }

        return squares.Determinant() > 0 && squares.Inverse() is var inverse ? Array.ConvertAll(sums, sum => inverse * sum) : known;
    }

    /// <summary>The base mesh, with the vertices whose images are nearest to those of all its elements.</summary>
    private Mesh MeshOf(Hypothesis description, (PlacedElement Element, int Symmetry)?[,] found, int first, int count)
    {
        var positions = ImmutableArray.CreateBuilder<double>();
        var corners = ImmutableArray.CreateBuilder<int>();
        for (var part = first; part < first + count; part++)
        {
            var template = model.Templates[description.Bases[part].Class];
            var known = template.Vertices.Select(vertex => description.Bases[part].Placement * vertex).ToArray();
            corners.AddRange(template.Corners.Select(corner => corner + (positions.Count / 3)));
            foreach (var point in PointsOf(description, found, part, VerticesOf, known))
            {
                positions.AddRange(point.X, point.Y, point.Z);
            }
        }

        return new(positions.ToImmutable(), corners.ToImmutable());

        Vector[] VerticesOf((PlacedElement Element, int Symmetry) element) => model.IsDecimated
            ? [.. model.Templates[element.Element.Class].Vertices.Select(vertex => PlacementOf(element) * vertex)]
            : Array.ConvertAll(
                model.Templates[element.Element.Class].Symmetries[element.Symmetry].Order, vertex => element.Element.Points[vertex]);
    }
}
