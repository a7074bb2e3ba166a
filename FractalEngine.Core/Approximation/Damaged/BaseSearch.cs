using FractalEngine.Core.Approximation.Damaged.Placements;
using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Approximation.Damaged;

/// <summary>Finds the base elements of given products of maps: those whose images explain more elements than they cost.</summary>
internal sealed class BaseSearch(DamagedModel model, PlacementIndex set, int seed, CancellationToken cancellation)
{
    private const int MaxStarts = 60;
    private const int MaxWords = 80;
    private const int SampleSize = 24;
    private const int MaxJudged = 10;

    // How many elements of one description a base has at most.
    private const int MaxBases = 6;

    private const double MinImages = 0.3;

    private readonly bool[] _isExplained = new bool[set.Count];

    /// <summary>Returns the description with its bases, and what it explains.</summary>
    public (Hypothesis Hypothesis, Explanation Explanation) Complete(Hypothesis description)
    {
        var words = description.Words().ConvertAll(word => word.Map);
        var bases = new List<(int Class, AffineMap Placement)>();
        while (bases.Count < MaxBases && FindNext(words) is { } found)
        {
            var images = ImagesOf(found, words);
            // Decimated elements that were placed wrong are where other bases are.
            if (model.IsDecimated && bases.Count > 0 && images.Count < MinImages * words.Count)
            {
                break;
            }

            foreach (var image in images)
            {
                _isExplained[image] = true;
            }

            bases.Add(found);
        }

        return (
            description with { Bases = bases },
            new(_isExplained.Count(isExplained => isExplained), bases.Count * words.Count, description.Maps.Count + bases.Count));
    }

    private HashSet<int> ImagesOf((int Class, AffineMap Placement) part, List<AffineMap> words)
    {
        cancellation.ThrowIfCancellationRequested();
        return [.. words.Select(word => set.Find(part.Class, word * part.Placement)).Where(image => image >= 0 && !_isExplained[image])];
    }

    private (int Class, AffineMap Placement)? FindNext(List<AffineMap> words)
    {
        var random = new Random(seed);
        var bySize = words.OrderByDescending(word => Math.Abs(word.Linear.Determinant())).ToArray();
        AffineMap[] tried = [.. bySize.Take(MaxWords / 2), .. bySize.Skip(MaxWords / 2).OrderBy(_ => random.Next()).Take(MaxWords / 2)];
        var sample = bySize.OrderBy(_ => random.Next()).Take(SampleSize).ToArray();
        var left = Enumerable.Range(0, set.Count).Where(member => !_isExplained[member]).ToArray();
        var starts = left.Take(MaxStarts / 2).Concat(left.Skip(MaxStarts / 2).OrderBy(_ => random.Next()).Take(MaxStarts / 2));
        var inverses = Array.ConvertAll(tried, word => word.Inverse());
        var known = model.CreateIndex(0.05);
        var candidates = new List<((int Class, AffineMap Placement) Base, int Hits)>();
        foreach (var start in starts)
        {
            cancellation.ThrowIfCancellationRequested();
            foreach (var inverse in inverses)
            {
                var candidate = (set[start].Class, Placement: inverse * set[start].Placement);
                if (known.Find(candidate.Class, candidate.Placement) >= 0)
                {
                    continue;
                }

                known.Add(candidate.Class, candidate.Placement);
                candidates.Add((candidate, sample.Count(
                    word => set.Find(candidate.Class, word * candidate.Placement) is var image && image >= 0 && !_isExplained[image])));
            }
        }

        var best = candidates.OrderByDescending(candidate => candidate.Hits).Take(MaxJudged)
            .Select(candidate => (candidate.Base, new Explanation(ImagesOf(candidate.Base, words).Count, words.Count, 1).Worth))
            .OrderByDescending(candidate => candidate.Worth).FirstOrDefault();
        return best.Worth > 0 ? best.Base : null;
    }
}
