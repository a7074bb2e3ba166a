using FractalEngine.Core.Fractals;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Visibility;

namespace FractalEngine.Tests.Fractals;

/// <summary>A camera that goes towards the fixed point of one of a fractal's maps, by way of an address.</summary>
internal sealed class FractalDive
{
    private readonly LodHierarchy _hierarchy;
    private readonly int _mapIndex;
    private int _matchingLevels;

    /// <summary>From a distance, in sizes of the fractal.</summary>
    /// <param name="hierarchy">Of a fractal with one set.</param>
    /// <param name="mapIndex">The copy whose fixed point is looked for.</param>
    /// <param name="placement">Of the fractal.</param>
    /// <param name="direction">From the fixed point to the camera, in the fractal's frame.</param>
    /// <param name="distance">Of the box's diagonal.</param>
    public FractalDive(LodHierarchy hierarchy, int mapIndex, AffineMap placement, Vector direction, double distance = 3)
    {
        (_hierarchy, _mapIndex) = (hierarchy, mapIndex);
        var top = hierarchy.NodeAt(hierarchy.LevelCount);
        var map = top.ChildMaps[mapIndex].ToAffineMap();
        FixedPoint = (Matrix.Identity + (-1 * map.Linear)).Inverse() * map.Translation;
        Start = placement * (FixedPoint + (distance * top.Box.Diagonal * direction.UnitVector()));
        Address = new(hierarchy, placement, Start);
        Address.Move(Vector.Zero);
    }

    /// <summary>In the fractal's frame.</summary>
    public Vector FixedPoint { get; }

    /// <summary>World space.</summary>
    public Vector Start { get; }

    public FractalAddress Address { get; }

    /// <summary>Steps that were taken, with the unit that each was told in.</summary>
    public List<(Vector Step, double LogUnit)> Steps { get; } = [];

    /// <summary>
    /// The same point of the fractal at whatever level, about the camera and in the present unit: where the fixed point, moved by an offset
    /// in the frame, lies.
    /// </summary>
    public Vector LocateTarget(Vector offset)
    {
        _matchingLevels = Math.Min(_matchingLevels, Address.Path.Count);
        while (_matchingLevels < Address.Path.Count && Address.Path[_matchingLevels] == _mapIndex)
        {
            _matchingLevels++;
        }

        // Of a fractal with one set each sub-fractal is like the whole.
        var point = FixedPoint + offset;
        for (var i = _matchingLevels; i < Address.Path.Count; i++)
        {
            point = _hierarchy.NodeAt(_hierarchy.LevelCount).ChildMaps[Address.Path[i]].ToAffineMap().Inverse() * point;
        }

        return Address.FrameToCamera * point;
    }

    public void Move(Vector step)
    {
        Steps.Add((step, Address.LogUnit));
        Address.Move(step);
    }

    /// <summary>Goes on, each time by a part of the way that is left, until it is as deep as asked for.</summary>
    public void GoToDepth(int depth, double fraction = 0.5)
    {
        for (var moves = 0; Address.Depth < depth; moves++)
        {
            Assert.True(moves < 100 + (100L * depth), $"at depth {Address.Depth} of {depth} after {moves} moves");
            Move(fraction * LocateTarget(Vector.Zero));
        }
    }

    /// <summary>
    /// Moves to an exact place relative to the fixed point, in the frame of the sub-fractal where that is; such places are kept when
    /// nothing is entered or left.
    /// </summary>
    public void ConvergeTo(Vector offset)
    {
        for (var i = 0; i < 20; i++)
        {
            Move(LocateTarget(offset));
        }
    }

    /// <summary>Back to the start.</summary>
    public void ReturnToStart()
    {
        for (var i = Steps.Count - 1; i >= 0; i--)
        {
            Address.Move(-Math.Exp(Steps[i].LogUnit - Address.LogUnit) * Steps[i].Step);
        }

        Steps.Clear();
    }
}
