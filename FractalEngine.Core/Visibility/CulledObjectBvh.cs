using FractalEngine.Core.Bvh.Objects;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Visibility.Frames;

namespace FractalEngine.Core.Visibility;

/// <summary>
/// A bounding volume hierarchy over the objects of a frame. It finds those that may be in the frustum without testing the others.
/// </summary>
/// <remarks>Objects that move between frames are refitted. Where nothing moves, an update allocates nothing.</remarks>
internal sealed class CulledObjectBvh
{
    /// <summary>The smallest number of objects for which the hierarchy is worth its cost.</summary>
    public const int MinObjects = 64;

    // Refitting more than one object in so many costs as much as building the hierarchy.
    private const int MaxRefittedShare = 8;

    // Relative to coordinates: more than the rounding of the maps from objects to the view.
    private const double RoundingMargin = 1e-12;

    private CulledObject[] _objects = [];
    private ObjectBvh? _bvh;

    /// <summary>Takes the objects of the next frame.</summary>
    /// <returns>False where all objects have to be tested: there are few, or some begin at sub-fractals.</returns>
    public bool TryUpdate(IReadOnlyList<CulledObject> objects)
    {
        if (objects.Count < MinObjects)
        {
            return false;
        }

        var changedCount = objects.Count == _objects.Length ? 0 : objects.Count;
        for (var i = 0; i < objects.Count; i++)
        {
            if (objects[i].Roots is not null)
            {
                return false;
            }

            changedCount += objects.Count == _objects.Length && !ReferenceEquals(objects[i], _objects[i]) ? 1 : 0;
        }

        if (_bvh is null || changedCount > objects.Count / MaxRefittedShare)
        {
            Build(objects);
        }
        else if (changedCount > 0)
        {
            Refit(objects);
        }

        return true;
    }

    /// <summary>Collects the objects whose boxes may be in the frustum of a strip.</summary>
    /// <param name="frame">Parameters of the strip.</param>
    /// <param name="ranks">Rank of each object in the order of culling.</param>
    /// <param name="candidates">Empty; receives the ranks of the objects, sorted. Objects without instances are left out.</param>
    public void CollectCandidates(in StripFrame frame, ReadOnlySpan<int> ranks, List<int> candidates)
    {
        Collect(in frame, frame.Axes.Inverse(), _bvh!.Root, ranks, candidates);
        candidates.Sort();
    }

    private static void Collect(in StripFrame frame, Matrix worldToView, ObjectBvhNode node, ReadOnlySpan<int> ranks, List<int> candidates)
    {
        for (var slot = 0; slot < node.ChildCount; slot++)
        {
            var box = node.BoxOf(slot);
            if (box.IsEmpty || IsOutside(in frame, worldToView, box))
            {
                continue;
            }

            if (node[slot] is ObjectBvhNode child)
            {
                Collect(in frame, worldToView, child, ranks, candidates);
            }
            else
            {
                candidates.Add(ranks[((ObjectBvhLeaf)node[slot]).Index]);
            }
        }
    }

    private static bool IsOutside(in StripFrame frame, Matrix worldToView, BoundingBox box)
    {
        var halfSize = 0.5 * box.Size;
        var centre = worldToView * (box.Centre - frame.Position);
        var margin = RoundingMargin * (box.Centre.MaxAbsComponent() + frame.Position.MaxAbsComponent() + halfSize.MaxAbsComponent());
        var viewHalfSize = worldToView.Absolute() * (halfSize + (margin * Vector.One));
        return frame.IsGroupOutside(SimdAffineMap.ToVector256(centre), SimdAffineMap.ToVector256(viewHalfSize));
    }

    private void Build(IReadOnlyList<CulledObject> objects)
    {
        _objects = [.. objects];
        _bvh = ObjectBvh.Build([.. objects.Select((item, index) => new ObjectBvhLeaf(index, WorldBoxOf(item)))]);
    }

    private void Refit(IReadOnlyList<CulledObject> objects)
    {
        for (var i = 0; i < objects.Count; i++)
        {
            if (!ReferenceEquals(objects[i], _objects[i]))
            {
                _objects[i] = objects[i];
                _bvh = _bvh!.With(new(i, WorldBoxOf(objects[i])));
            }
        }

        if (_bvh!.IsDegraded)
        {
            Build(objects);
        }
    }

    private static BoundingBox WorldBoxOf(CulledObject item)
    {
        var node = item.Hierarchy.NodeAt(item.Hierarchy.LevelCount);
        if (node.IsEmpty)
        {
            return BoundingBox.Empty;
        }

        var map = item.ObjectToWorld;
        var box = node.Box.Transform(map);
        var magnitude = (map.Linear.Absolute() * (node.Box.Centre.Absolute() + node.Box.Size)) + map.Translation.Absolute();
        var margin = RoundingMargin * magnitude.MaxAbsComponent() * Vector.One;
        box = new(box.Minimum - margin, box.Maximum + margin);
        // What has no finite box is always tested.
        return box.Size.IsFinite() && !box.IsEmpty
            ? box : new(double.NegativeInfinity * Vector.One, double.PositiveInfinity * Vector.One);
    }
}
