using System.Runtime.InteropServices;
using FractalEngine.Core.Geometry;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Physics.Descriptions;

namespace FractalEngine.Core.Physics.Bodies;

/// <summary>
/// Finds the bodies that one mover may meet. What the cells around it hold is collected once; each search then tests these bodies only,
/// as long as it stays within the cells.
/// </summary>
internal sealed class NearbyBodies(BodyGrid grid, List<Body>? bodies = null)
{
    private readonly List<int> _inCells = [];
    private BodyGrid.CellRange _cells;
    private long _version = -1;

    /// <summary>Makes room for so many bodies near a mover.</summary>
    public void Reserve(int bodyCount) => _inCells.EnsureCapacity(bodyCount);

    /// <summary>Collects what the cells about a box hold, if they are few enough, so that searches within it are fast.</summary>
    /// <param name="pathBounds">Box in which the centre of the mover is likely to stay.</param>
    /// <param name="radius">Radius of the mover's spheres, scene units.</param>
    /// <param name="excludedIndex">Index of the mover itself.</param>
    /// <returns>True where the mover is known to meet no other body as long as it stays in the box, and none moves.</returns>
    public bool Prepare(in BoundingBox pathBounds, double radius, int excludedIndex)
    {
        if (!TryCollect(grid.CellsAround(in pathBounds, radius)) || grid.LargeBodies.Count > 0)
        {
            return false;
        }

        foreach (var index in _inCells)
        {
            if (index != excludedIndex && grid.Overlaps(index, in pathBounds, radius))
            {
                return false;
            }
        }

        return true;
    }

    /// <summary>Collects the bodies that a moving sphere may meet.</summary>
    /// <param name="pathBounds">Box that holds the path of its centre.</param>
    /// <param name="radius">Radius of the sphere, scene units.</param>
    /// <param name="excludedIndex">Index of the sphere itself, or <see cref="Contact.NoBody"/>.</param>
    /// <param name="results">Receives the indices, in no particular order, but always in the same.</param>
    public void CollectOverlaps(in BoundingBox pathBounds, double radius, int excludedIndex, List<int> results)
    {
        foreach (var index in grid.LargeBodies)
        {
            if (index != excludedIndex && grid.Overlaps(index, in pathBounds, radius) && CanMeet(index, excludedIndex))
            {
                results.Add(index);
            }
        }

        var cells = grid.CellsAround(in pathBounds, radius);
        var isCollected = (_version == grid.Version && _cells.Contains(in cells)) || TryCollect(in cells);
        if (!isCollected)
        {
            _inCells.Clear();
            _version = -1;
            grid.CollectAll(_inCells);
        }

        foreach (var index in _inCells)
        {
            if (index != excludedIndex && (!isCollected || grid.IsWithin(index, in cells)) && grid.Overlaps(index, in pathBounds, radius)
                && CanMeet(index, excludedIndex))
            {
                results.Add(index);
            }
        }
    }

    /// <summary>Collects the bodies that a sphere overlaps. What was collected for a mover stays as it is.</summary>
    /// <param name="centre">Its centre, world space.</param>
    /// <param name="radius">Its radius, scene units.</param>
    /// <param name="excludedIndex">Index of the body that the sphere belongs to.</param>
    /// <param name="results">Receives the indices, in no particular order, but always in the same.</param>
    public void CollectOverlaps(Vector centre, double radius, int excludedIndex, List<int> results)
    {
        var firstIndex = results.Count;
        if (HasFilters || grid.LargeBodies.Count > 0 || !grid.TryCollectOverlaps(centre, radius, excludedIndex, results))
        {
            CollectionsMarshal.SetCount(results, firstIndex);
            CollectOverlaps(new BoundingBox(centre, centre), radius, excludedIndex, results);
        }
    }

    /// <summary>True once a body has another layer or mask than others.</summary>
    public bool HasFilters { get; set; }

    private bool CanMeet(int index, int excludedIndex)
    {
        if (!HasFilters || excludedIndex < 0 || bodies is null)
        {
            return true;
        }

        var (first, second) = (bodies[index].Description, bodies[excludedIndex].Description);
        return Layers.CanMeet(first.Layer, first.Mask, second.Layer, second.Mask);
    }

    private bool TryCollect(in BodyGrid.CellRange cells)
    {
        _inCells.Clear();
        _version = -1;
        if (!grid.TryCollect(in cells, _inCells))
        {
            return false;
        }

        _cells = cells;
        _version = grid.Version;
        return true;
    }
}
