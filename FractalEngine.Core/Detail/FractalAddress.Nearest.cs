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
        _open.Clear();
        foreach (var root in Roots(NearAncestors))
        {
            Open(root.Levels, root.Map);
        }

        var nearest = 0.0;
        for (var parts = 0; parts < MostParts && _open.TryDequeue(out var part, out nearest); parts++)
        {
            var state = _table.At(part.Levels);
            if (state.Maps.Length == 0 || state.Box.Transform(part.Map).Diagonal <= Fine * nearest)
            {
                break;
            }

            for (var child = 0; child < state.Maps.Length; child++)
            {
                Open(Below(part.Levels, state.Downs[child]), part.Map * state.Maps[child].ToMap());
            }
        }

        // Among parts that are never far, as in a solid: the scale of what is around.
        var size = State.Box.Transform(_about).Diagonal;
        return Math.Max(nearest, 1e-3 * size);
    }

    /// <summary>
    /// Where copies overlap, what is nearest may be in another one than that which the camera is in, and far smaller than it: then the camera is told relative to that one.
    /// </summary>
    private void Change()
    {
        if (FindNearest(out var up, out var down) > Small * State.Box.Transform(_about).Diagonal || down.Count == 0)
        {
            return;
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

    /// <summary>Finds a part about as small as it is near.</summary>
    /// <param name="up">How many copies to leave to come there.</param>
    /// <param name="down">Then the copies to go into.</param>
    /// <returns>Its distance.</returns>
    private double FindNearest(out int up, out List<int> down)
    {
        var open = new PriorityQueue<(int Up, int Node), double>();
        var nodes = new List<(int Parent, int Child, long Levels, AffineMap Map)>();
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

            nodes.Add((-1, -1, _levels[i], map));
            AddParts(_path.Count - i, nodes.Count - 1, left);
        }

        var (nearest, found) = (0.0, (Up: 0, Node: -1));
        for (var parts = 0; parts < MostParts && open.TryDequeue(out found, out nearest); parts++)
        {
            var (_, _, levels, place) = nodes[found.Node];
            var state = _table.At(levels);
            if (state.Maps.Length == 0 || state.Box.Transform(place).Diagonal <= nearest)
            {
                break;
            }

            AddParts(found.Up, found.Node, -1);
        }

        (up, down) = (found.Up, []);
        for (var node = found.Node; node >= 0 && nodes[node].Parent >= 0; node = nodes[node].Parent)
        {
            down.Insert(0, nodes[node].Child);
        }

        return nearest;

        void AddParts(int copies, int parent, int left)
        {
            var (_, _, levels, place) = nodes[parent];
            var state = _table.At(levels);
            for (var child = 0; child < state.Maps.Length; child++)
            {
                var below = _table.At(Below(levels, state.Downs[child]));
                if (child != left && !below.IsEmpty)
                {
                    var childMap = place * state.Maps[child].ToMap();
                    nodes.Add((parent, child, Below(levels, state.Downs[child]), childMap));
                    open.Enqueue((copies, nodes.Count - 1), Distance(below.Box.Transform(childMap), Vector.Zero));
                }
            }
        }
    }

    private void Open(long levels, AffineMap map)
    {
        var state = _table.At(levels);
        if (!state.IsEmpty)
        {
            _open.Enqueue((levels, map), Distance(state.Box.Transform(map), Vector.Zero));
        }
    }
}
