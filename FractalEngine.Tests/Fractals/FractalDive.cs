using FractalEngine.Core.DeepZoom;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Visibility.Levels;

namespace FractalEngine.Tests.Fractals;

/// <summary>A camera that approaches the fixed point of one of a fractal's maps, with its <see cref="FractalAddress"/>.</summary>
internal sealed class FractalDive
{
    private readonly LodHierarchy _hierarchy;
    private readonly int _mapIndex;
    private int _matchingLevels;

    /// <summary>Places the camera at a distance from the fixed point.</summary>
    /// <param name="hierarchy">Hierarchy of a fractal with one set.</param>
    /// <param name="mapIndex">Index of the child instance whose fixed point is approached.</param>
    /// <param name="placement">Map from the fractal's frame to world space.</param>
    /// <param name="direction">Direction from the fixed point to the camera, in the fractal's frame.</param>
    /// <param name="distance">Distance in diagonals of the fractal's box.</param>
    public FractalDive(LodHierarchy hierarchy, int mapIndex, AffineMap placement, Vector direction, double distance = 3)
    {
        _hierarchy = hierarchy;
        _mapIndex = mapIndex;
        var top = hierarchy.NodeAt(hierarchy.LevelCount);
        var map = top.ChildMaps[mapIndex].ToAffineMap();
        FixedPoint = (Matrix.Identity + (-1 * map.Linear)).Inverse() * map.Translation;
        Start = placement * (FixedPoint + (distance * top.Box.Diagonal * direction.UnitVector()));
        Address = new(hierarchy, placement, Start);
        Address.Move(Vector.Zero);
    }

    /// <summary>Fixed point of the map, in the fractal's frame.</summary>
    public Vector FixedPoint { get; }

    /// <summary>First position of the camera, world space.</summary>
    public Vector Start { get; }

    /// <summary>Address of the camera.</summary>
    public FractalAddress Address { get; }

    /// <summary>Steps of the camera, with the unit that each was in.</summary>
    public List<(Vector Step, double LogUnit)> Steps { get; } = [];

    /// <summary>Locates the fixed point, moved by an offset in the present frame, relative to the camera and in the present unit.</summary>
    public Vector LocateTarget(Vector offset)
    {
        _matchingLevels = Math.Min(_matchingLevels, Address.Path.Count);
        while (_matchingLevels < Address.Path.Count && Address.Path[_matchingLevels] == _mapIndex)
        {
            _matchingLevels++;
        }

        // In a fractal with one set each sub-fractal is like the whole.
        var point = FixedPoint + offset;
        for (var i = _matchingLevels; i < Address.Path.Count; i++)
        {
            point = _hierarchy.NodeAt(_hierarchy.LevelCount).ChildMaps[Address.Path[i]].ToAffineMap().Inverse() * point;
        }

        return Address.FrameToCamera * point;
    }

    /// <summary>Moves the camera, and records the step.</summary>
    public void Move(Vector step)
    {
        Steps.Add((step, Address.LogUnit));
        Address.Move(step);
    }

    /// <summary>Approaches the fixed point by a fraction of the remaining distance each time, until the address has a depth.</summary>
    public void GoToDepth(int depth, double fraction = 0.5)
    {
        for (var moves = 0; Address.Depth < depth; moves++)
        {
            Assert.True(moves < 100 + (100L * depth), $"at depth {Address.Depth} of {depth} after {moves} moves");
            Move(fraction * LocateTarget(Vector.Zero));
        }
    }

    /// <summary>Moves to an exact position relative to the fixed point, in the frame of the sub-fractal there.</summary>
    /// <remarks>The position is kept as long as no sub-fractal is entered or left.</remarks>
    public void ConvergeTo(Vector offset)
    {
        for (var i = 0; i < 20; i++)
        {
            Move(LocateTarget(offset));
        }
    }

    /// <summary>Moves back to the start, by the recorded steps in reverse.</summary>
    public void ReturnToStart()
    {
        for (var i = Steps.Count - 1; i >= 0; i--)
        {
            Address.Move(-Math.Exp(Steps[i].LogUnit - Address.LogUnit) * Steps[i].Step);
        }

        Steps.Clear();
    }
}
