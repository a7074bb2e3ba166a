using System.Runtime.InteropServices;

namespace FractalEngine.Core.Physics.Islands;

/// <content>How contacts and bodies are put into the order of their islands.</content>
internal sealed partial class ContactGraph
{
    private void GroupByIslands()
    {
        _islands.Clear();
        _islandBodies.Clear();
        CountBodies();
        RowCount = 0;
        for (var i = 0; i < _count; i++)
        {
            if (IslandOf(_found[i].First) is var island and >= 0)
            {
                _islands[island] = _islands[island] with { RowCount = _islands[island].RowCount + 1 };
                RowCount++;
            }
        }

        if (_rows.Length < RowCount)
        {
            _rows = new ContactRow[2 * RowCount];
        }

        PlaceRows();
    }

    private int IslandOf(int body) => _islandOf[_sets.RootOf(body)];

    /// <summary>Makes an island of each root with another body, and lists its bodies.</summary>
    private void CountBodies()
    {
        for (var i = 0; i < bodies.Count; i++)
        {
            var root = _sets.RootOf(i);
            if (root != i && _islandOf[root] < 0)
            {
                _islandOf[root] = int.MaxValue;
            }
        }

        for (var i = 0; i < bodies.Count; i++)
        {
            var root = _sets.RootOf(i);
            if (_islandOf[root] == int.MaxValue)
            {
                _islandOf[root] = _islands.Count;
                _islands.Add(default);
            }

            if (_islandOf[root] is var island and >= 0)
            {
                _islands[island] = _islands[island] with { BodyCount = _islands[island].BodyCount + 1 };
            }
        }

        var firstBody = 0;
        for (var island = 0; island < _islands.Count; island++)
        {
            _islands[island] = _islands[island] with { FirstBody = firstBody };
            firstBody += _islands[island].BodyCount;
            _nextBody[island] = _islands[island].FirstBody;
        }

        CollectionsMarshal.SetCount(_islandBodies, firstBody);
        for (var i = 0; i < bodies.Count; i++)
        {
            if (IslandOf(i) is var island and >= 0)
            {
                _islandBodies[_nextBody[island]++] = i;
            }
        }
    }

    private void PlaceRows()
    {
        var firstRow = 0;
        for (var island = 0; island < _islands.Count; island++)
        {
            _islands[island] = _islands[island] with { FirstRow = firstRow };
            _nextBody[island] = firstRow;
            firstRow += _islands[island].RowCount;
        }

        for (var i = 0; i < _count; i++)
        {
            if (IslandOf(_found[i].First) is var island and >= 0)
            {
                _rows[_nextBody[island]++] = _found[i];
            }
        }
    }
}
