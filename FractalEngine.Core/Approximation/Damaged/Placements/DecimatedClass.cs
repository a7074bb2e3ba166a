using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Approximation.Damaged.Placements;

/// <summary>Decimated elements that are images of one element, and the maps that take each of them to the first one.</summary>
/// <param name="First">The element with most vertices.</param>
/// <param name="Members">All elements with their maps, the first one among them.</param>
/// <param name="Shared">The vertices of all of them, in the frame of the first one.</param>
internal sealed record DecimatedClass(
    DecimatedElement First, List<(DecimatedElement Element, AffineMap Map)> Members, SharedVertices Shared)
{
    private const int Rounds = 2;
    private const int FirstShared = 10;

    // Where so many elements are like none of so many others, the others hardly are: to compare all takes long.
    private const int MaxAlone = 8;
    private const int MaxTried = 30;

    // That part of the vertices lies on vertices after a symmetry.
    private const double SymmetricPart = 0.8;

    /// <summary>The maps that take what the elements are images of to itself.</summary>
    public List<AffineMap> Symmetries => Shared.FindSymmetries(SymmetricPart);

    /// <summary>Sorts elements into classes; those that share too few vertices with any other one are left out.</summary>
    public static List<DecimatedClass> Find(List<DecimatedElement> elements, CancellationToken cancellation)
    {
        var classes = new List<DecimatedClass>();
        var left = elements.OrderByDescending(element => element.Shape.Points.Length).ToList();
        var alone = 0;
        while (left.Count > 1 && alone < MaxAlone)
        {
            cancellation.ThrowIfCancellationRequested();
            var found = new DecimatedClass(left[0], [(left[0], AffineMap.Identity)], new(left[0]));
            left.RemoveAt(0);
            if (!left.Take(MaxTried).Any(element => found.Shared.Match(element, isWeighted: false).Shared >= SharedVertices.MinShared))
            {
                alone++;
                continue;
            }

            // What more vertices prove comes first, so that it may tell vertices that prove others.
            var needed = FirstShared;
            while (needed >= SharedVertices.MinShared)
            {
                needed -= left.RemoveAll(
                    element => found.TryAdd(element, found.Shared, needed, isRevised: false, cancellation)) == 0 ? 1 : 0;
            }

            classes.Add(found.Revise(cancellation));
        }

        return classes;
    }

    /// <summary>Places elements again where most others agree: some had been placed by parts that are like others.</summary>
    private DecimatedClass Revise(CancellationToken cancellation)
    {
        var revised = this;
        for (var round = 0; round < Rounds; round++)
        {
            var next = new DecimatedClass(First, [(First, AffineMap.Identity)], new(First));
            foreach (var (element, _) in revised.Members.Skip(1))
            {
                next.TryAdd(element, revised.Shared, SharedVertices.MinShared, isRevised: true, cancellation);
            }

            revised = next;
        }

        return revised;
    }

    private bool TryAdd(DecimatedElement element, SharedVertices known, int needed, bool isRevised, CancellationToken cancellation)
    {
        cancellation.ThrowIfCancellationRequested();
        var (map, shared) = known.Match(element, isRevised);
        if (shared >= needed)
        {
            Members.Add((element, map));
            Shared.Add(element, map);
        }

        return shared >= needed;
    }
}
