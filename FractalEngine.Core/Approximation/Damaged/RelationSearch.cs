using System.Runtime.InteropServices;
using FractalEngine.Core.Approximation.Damaged.Placements;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Approximation.Damaged;

/// <summary>Finds the maps that take most elements to elements.</summary>
/// <remarks>
/// Where vertices are exact, all maps between pairs vote, and equal ones are counted by hashing. Where they are noisy, maps start at the
/// largest elements, and grow: they are fitted to the neighbours that they take to elements, then to twice as many, and so on.
/// </remarks>
internal sealed class RelationSearch(DamagedModel model, PlacementIndex set, IReadOnlyList<double> weights, CancellationToken cancellation)
{
    private const int MaxVotes = 600_000;
    private const int MaxVoted = 240;
    private const int MaxGrown = 60_000;

    // Maps of exact vertices agree within that part of the diagonal, over the whole model.
    private const double VoteCell = 1e-4;
    private const double MinVolume = 1e-9;

    // Hardly any two elements are level in this direction.
    private static readonly Vector OddVector = new(0.6180339887, 0.5436890127, 0.4655712319);

    /// <summary>The elements that maps are looked for between.</summary>
    public PlacementIndex Set => set;

    /// <summary>What each element counts.</summary>
    public IReadOnlyList<double> Weights => weights;

    /// <summary>Returns relations with a support of at least two elements, the best first.</summary>
    /// <param name="effort">Budget, 1 unless stated.</param>
    public List<Relation> Find(double effort)
    {
        var byClass = Enumerable.Range(0, set.Count).GroupBy(member => set[member].Class)
            .OrderByDescending(group => group.Count()).ThenBy(group => group.Key).FirstOrDefault()?.ToArray() ?? [];
        if (byClass.Length < 2)
        {
            return [];
        }

        var maps = model.IsExact ? Vote(byClass, effort) : Grow(byClass, effort);
        return [.. maps.Where(CanInvert).Select(map => new Relation(map, SupportOf(map))).Where(relation => relation.Support > 0)
            .OrderByDescending(relation => relation.Support)];
    }

    /// <summary>Whether a map and its inverse are known well enough to use both.</summary>
    public static bool CanInvert(AffineMap map) => Math.Abs(map.Linear.Determinant()) is > MinVolume and < 1 / MinVolume;

    /// <summary>Computes how many elements a map takes to others.</summary>
    public double SupportOf(AffineMap map)
    {
        cancellation.ThrowIfCancellationRequested();
        var sum = 0.0;
        for (var member = 0; member < set.Count; member++)
        {
            var image = set.Find(set[member].Class, map * set[member].Placement);
            sum += image >= 0 && image != member ? weights[member] * weights[image] : 0;
        }

        return sum;
    }

    /// <summary>Returns the first relations, of those that do the same only one.</summary>
    public List<Relation> Distinct(IEnumerable<Relation> relations, int count)
    {
        var distinct = new List<Relation>();
        distinct.AddRange(relations.Where(relation => !distinct.Exists(known => IsSame(known.Map, relation.Map))).Take(count));
        return distinct;
    }

    /// <summary>Whether two maps take most elements that both take to elements to the same ones.</summary>
    public bool IsSame(AffineMap map1, AffineMap map2)
    {
        var (same, both) = (0, 0);
        for (var member = 0; member < set.Count; member++)
        {
            var (elementClass, placement) = set[member];
            if (set.Find(elementClass, map1 * placement) is var image && image >= 0
                && set.Find(elementClass, map2 * placement) is var other && other >= 0)
            {
                both++;
                same += image == other ? 1 : 0;
            }
        }

        return 2 * same > both;
    }

    private List<AffineMap> Vote(int[] members, double effort)
    {
        var template = model.Templates[set[members[0]].Class];
        var symmetries = template.Symmetries[..template.CountSymmetries(PlacedElement.SizeOf(set[members[0]].Placement))];
        // The largest ones may all be foreign.
        var random = new Random(0);
        var order = members.OrderBy(_ => random.Next()).OrderByDescending(member => weights[member]).ToArray();
        var references = Math.Min(order.Length, Math.Max(8, (int)(effort * MaxVotes / (symmetries.Length * order.Length))));
        var votes = new Dictionary<long, (double Count, int From, int To, int Symmetry)>();
        for (var from = 0; from < references; from++)
        {
            cancellation.ThrowIfCancellationRequested();
            var back = set[order[from]].Placement.Inverse();
            for (var to = 0; to < order.Length; to++)
            {
                // Each pair once.
                for (var symmetry = 0; symmetry < symmetries.Length && (to > from || to >= references); symmetry++)
                {
                    ref var vote = ref CollectionsMarshal.GetValueRefOrAddDefault(votes, KeyOf(MapOf(back, to, symmetry)), out _);
                    vote = (vote.Count + (weights[order[from]] * weights[order[to]]), from, to, symmetry);
                }
            }
        }

        var least = 1.2 * weights.Max() * weights.Max();
        return [.. votes.Values.Where(vote => vote.Count > least).OrderByDescending(vote => vote.Count)
            .ThenBy(vote => vote.From).ThenBy(vote => vote.To).ThenBy(vote => vote.Symmetry).Take(MaxVoted)
            .Select(vote => MapOf(set[order[vote.From]].Placement.Inverse(), vote.To, vote.Symmetry))];

        AffineMap MapOf(AffineMap back, int to, int symmetry) => Directed(
            PlacedElement.After(symmetries[symmetry].Map, set[order[to]].Placement) * back);
    }

    /// <summary>Of a map and its inverse the one that makes smaller, or else moves in the direction of an odd vector.</summary>
    private AffineMap Directed(AffineMap map)
    {
        var volume = Math.Abs(map.Linear.Determinant());
        var move = (map * model.Centre) - model.Centre;
        return volume > 1.0001 || (volume > 0.9999 && Vector.Dot(move, OddVector) < 0) ? map.Inverse() : map;
    }

    private long KeyOf(AffineMap map)
    {
        var key = 17L;
        for (var index = 0; index < 4; index++)
        {
            var axis = index switch { 0 => Vector.Zero, 1 => Vector.I, 2 => Vector.J, _ => Vector.K };
            var image = ((map * (model.Centre + (0.5 * model.Diagonal * axis))) - model.Centre) / (VoteCell * model.Diagonal);
            // A third of a cell aside, so that round numbers are not on the side of a cell.
            foreach (var coordinate in new[] { image.X, image.Y, image.Z })
            {
                key = unchecked((key * 0x2545F4914F6CDD1DL) ^ (long)Math.Floor(coordinate + 0.3141)) ^ (key >>> 29);
            }
        }

        return key;
    }

    private List<AffineMap> Grow(int[] members, double effort)
    {
        var maps = new List<AffineMap>();
        var growth = new MapGrowth(model, set);
        var template = model.Templates[set[members[0]].Class];
        // Maps of thin elements are uncertain across them.
        var references = members.OrderByDescending(member => ThicknessOf(set[member].Placement)).ToArray();
        var count = Math.Min(3, Math.Max(1, (int)(effort * MaxGrown / (template.Symmetries.Length * members.Length))));
        foreach (var reference in references.Take(count))
        {
            var order = growth.NeighboursOf(reference);
            var back = set[reference].Placement.Inverse();
            foreach (var member in members.Where(member => member != reference))
            {
                cancellation.ThrowIfCancellationRequested();
                var size = PlacedElement.SizeOf(set[member].Placement);
                foreach (var symmetry in template.Symmetries.Take(template.CountSymmetries(size)))
                {
                    var map = PlacedElement.After(symmetry.Map, set[member].Placement) * back;
                    if (growth.Extend(map, order) is { } grown)
                    {
                        maps.Add(grown);
                    }
                }
            }
        }

        return maps;
    }

    private static double ThicknessOf(AffineMap placement) =>
        Math.Abs(placement.Linear.Determinant()) / (PlacedElement.SizeOf(placement) * PlacedElement.SizeOf(placement));
}
