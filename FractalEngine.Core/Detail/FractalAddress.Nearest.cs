using FractalEngine.Core.Maths;

namespace FractalEngine.Core.Detail;

/// <content>What is nearest to the camera.</content>
public sealed partial class FractalAddress
{
    /// <summary>
    /// About how far the nearest surface is, in the present unit: to a tenth, unless more than some thousand parts are about as near. To the box of the base mesh, where that is near.
    /// </summary>
    public double NearestDistance()
    {
        // Asked for several times a picture; it changes with the place only.
        if (_nearest is { } known)
        {
            return known;
        }

        var state = State;
        var distance = state.Maps.Length == 0 ? Distance(state.Box.Transform(_about), Vector.Zero) : FindNearest(Fine, out _, out _);
        // Among parts that are never far, as in a solid: the scale of what is around.
        _nearest = Math.Max(distance, 1e-3 * state.Box.Transform(_about).Diagonal);
        return _nearest.Value;
    }

    /// <summary>
    /// Where copies overlap, what is nearest may be in another one than that which the camera is in, and far smaller than it: then the camera is told relative to that one.
    /// </summary>
    private void Change()
    {
        if (FindNearest(1, out var up, out var node) > Small * State.Box.Transform(_about).Diagonal || node < 0)
        {
            return;
        }

        var down = new List<int>();
        for (; _nodes[node].Parent >= 0; node = _nodes[node].Parent)
        {
            down.Insert(0, _nodes[node].Child);
        }

        for (; up > 0; up--)
        {
            Leave();
        }

        foreach (var child in down)
        {
            if (_table.At(Below(_levels[^1], State.Downs[child])).Maps.Length == 0 || !TryEnter(child))
            {
                break;
            }
        }
    }

    /// <summary>Finds a part that is small compared with how near it is.</summary>
    /// <param name="fine">What counts as small, as a part of the distance.</param>
    /// <param name="up">How many copies to leave to come there.</param>
    /// <param name="node">Its number among <see cref="_nodes"/>, which lead back to what was left for it; −1 for none.</param>
    /// <returns>Its distance.</returns>
    private double FindNearest(double fine, out int up, out int node)
    {
        _nodes.Clear();
        _open.Clear();
        var map = _about;
        for (var i = _path.Count; i >= Math.Max(0, _path.Count - NearAncestors); i--)
        {
            // What was left is a part of what it was left for, and would be met twice.
            var left = i == _path.Count ? -1 : _path[i];
            map = i == _path.Count ? map : map * _table.At(_levels[i]).Maps[_path[i]].ToMap().Inverse();
            if (!map.IsFinite() || map.Linear.MaximumEntry() > Outermost)
            {
                break;
            }

            _nodes.Add((-1, -1, _levels[i], map));
            Open(_path.Count - i, _nodes.Count - 1, left);
        }

        var (nearest, found) = (0.0, (Up: 0, Node: -1));
        for (var parts = 0; parts < MostParts && _open.TryDequeue(out found, out nearest); parts++)
        {
            var (_, _, levels, place) = _nodes[found.Node];
            var state = _table.At(levels);
            if (state.Maps.Length == 0 || state.Box.Transform(place).Diagonal <= fine * nearest)
            {
                break;
            }

            Open(found.Up, found.Node, -1);
        }

        (up, node) = found;
        return nearest;
    }

    /// <summary>Puts the copies of a part into the queue, but for the one that was left.</summary>
    private void Open(int up, int parent, int left)
    {
        var (_, _, levels, map) = _nodes[parent];
        var state = _table.At(levels);
        for (var child = 0; child < state.Maps.Length; child++)
        {
            var below = Below(levels, state.Downs[child]);
            if (child != left && !_table.At(below).IsEmpty)
            {
                var childMap = map * state.Maps[child].ToMap();
                _nodes.Add((parent, child, below, childMap));
                _open.Enqueue((up, _nodes.Count - 1), Distance(_table.At(below).Box.Transform(childMap), Vector.Zero));
            }
        }
    }
}
