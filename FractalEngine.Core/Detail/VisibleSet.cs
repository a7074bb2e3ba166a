namespace FractalEngine.Core.Detail;

/// <summary>
/// What is drawn of a scene's fractals in one picture. Made once and filled again for every picture: after the first ones nothing is allocated. The same view gives the same
/// instances, in the same order, on any number of threads.
/// </summary>
public sealed class VisibleSet
{
    // A number that does not depend on the machine, so that neither does the result.
    private const int Strips = 8;
    // Steps are three times as long from the fifth on: what is far from fitting takes long to look at.
    private const double Coarsening = 1.5;
    private const int FineSteps = 4;

    private readonly StripSearch[] _strips = new StripSearch[Strips];
    private readonly InstanceRows _shared = new(hasPaths: false);
    private readonly HashSet<(int, ulong)> _seen = [];
    private readonly ParallelOptions _parallel = new();
    private readonly Action<int> _fillStrip;
    private int _coarsening;
    private int[] _order = [];
    private double[] _keys = [];
    private int[] _ends = [];
    private int[] _sharedEnds = [];
    private int[] _mergedEnds = [];
    private bool[] _isCut = [];
    private IReadOnlyList<DetailObject> _objects = [];
    private DetailSettings _settings = new();
    private DetailView _view;
    private int _budget;
    private volatile bool _isOverBudget;
    private int _found;

    /// <summary>An empty set.</summary>
    public VisibleSet()
    {
        for (var i = 0; i < Strips; i++)
        {
            _strips[i] = new();
        }

        _fillStrip = FillStrip;
    }

    /// <summary>Floats of one instance: the three rows of a 3×4 map from the drawn mesh's frame to world axes about the camera.</summary>
    public static int InstanceFloats => InstanceRows.Floats;

    /// <summary>What it took.</summary>
    public DetailCost Cost { get; private set; }

    /// <summary>How many instances are drawn.</summary>
    public int InstanceCount { get; private set; }

    /// <summary>What counted as small, pixels: that of the settings, or more where the budget asked for it.</summary>
    public double PixelSize { get; private set; }

    /// <summary>Bytes of the instances' memory.</summary>
    public long StorageBytes => _shared.StorageBytes + _strips.Sum(strip => strip.Rows.StorageBytes + strip.Shared.StorageBytes);

    /// <summary>Chooses what is drawn.</summary>
    /// <param name="view">How the scene is looked at.</param>
    /// <param name="objects">Of the scene.</param>
    /// <param name="settings">What is left out.</param>
    public void Fill(in DetailView view, IReadOnlyList<DetailObject> objects, DetailSettings settings)
    {
        (_view, _objects, _settings) = (view, objects, settings);
        // However coarse, each object is one instance, or one for each of its roots.
        var least = 0;
        for (var i = 0; i < objects.Count; i++)
        {
            least += objects[i].Roots?.Length ?? 1;
        }

        _budget = Math.Max(settings.InstanceBudget, least);
        _parallel.MaxDegreeOfParallelism = Math.Max(1, settings.Threads);
        Prepare();
        // Of a ladder of sizes the smallest that fits, looked for near the one of the picture before.
        var step = Math.Max(0, _coarsening - 1);
        var fits = TryFill(step);
        while (fits && step > 0 && TryFill(step - 1))
        {
            step--;
        }

        if (fits && step > 0)
        {
            // The smaller one did not fit, but is what there is now.
            fits = TryFill(step);
        }

        while (!fits)
        {
            fits = TryFill(++step);
        }

        _coarsening = step;
    }

    /// <summary>The number of parts that an object's instances come in.</summary>
    public static int PartCount => Strips + 1;

    /// <summary>A part of an object's instances, [n × 12].</summary>
    /// <param name="item">The object's place in the list.</param>
    /// <param name="part">Less than <see cref="PartCount"/>.</param>
    public ReadOnlySpan<float> Part(int item, int part)
    {
        var (start, end) = RangeOf(item, part);
        return (part < Strips ? _strips[part].Rows : _shared).Span[(start * InstanceRows.Floats)..(end * InstanceRows.Floats)];
    }

    /// <summary>Numbers between two colours, one an instance of <see cref="Part"/>, of an object that has a gradient.</summary>
    public ReadOnlySpan<float> Tints(int item, int part)
    {
        var (start, end) = RangeOf(item, part);
        // Where there are none, the list may be shorter than what comes before them.
        return start == end ? [] : (part < Strips ? _strips[part].Rows : _shared).Tints[start..end];
    }

    /// <summary>How many instances are drawn of an object.</summary>
    public int CountOf(int item)
    {
        var count = 0;
        for (var part = 0; part < PartCount; part++)
        {
            count += Part(item, part).Length / InstanceRows.Floats;
        }

        return count;
    }

    private (int Start, int End) RangeOf(int item, int part)
    {
        var ends = part < Strips ? _ends.AsSpan(part * _objects.Count, _objects.Count) : _mergedEnds;
        var place = Array.IndexOf(_order, item, 0, _objects.Count);
        return (place == 0 ? 0 : ends[place - 1], ends[place]);
    }

    /// <summary>True when the near plane cuts through an instance of an object: then the inner side of a solid may be seen.</summary>
    public bool IsCut(int item)
    {
        var place = Array.IndexOf(_order, item, 0, _objects.Count);
        for (var index = 0; index < Strips; index++)
        {
            if (_isCut[(index * _objects.Count) + place])
            {
                return true;
            }
        }

        return false;
    }

    /// <summary>Chooses with so many steps of coarsening.</summary>
    /// <returns>False when there is more than the budget.</returns>
    private bool TryFill(int step)
    {
        (_isOverBudget, _found) = (false, 0);
        PixelSize = step == 0 ? _settings.PixelSize : Math.Max(_settings.PixelSize, 1) * Math.Pow(Coarsening, step + Math.Max(0, 2 * (step - FineSteps)));
        if (_settings.Threads > 1)
        {
            Parallel.For(0, Strips, _parallel, _fillStrip);
        }
        else
        {
            for (var i = 0; i < Strips; i++)
            {
                FillStrip(i);
            }
        }

        if (_isOverBudget)
        {
            return false;
        }

        Merge();
        return InstanceCount <= _budget;
    }

    /// <summary>Sorts the objects, the nearest first, so that they hide those behind.</summary>
    private void Prepare()
    {
        var count = _objects.Count;
        if (_order.Length < count)
        {
            (_order, _keys) = (new int[count], new double[count]);
        }

        if (_ends.Length < Strips * count)
        {
            (_ends, _sharedEnds, _mergedEnds, _isCut) = (new int[Strips * count], new int[Strips * count], new int[count], new bool[Strips * count]);
        }

        for (var i = 0; i < count; i++)
        {
            var item = _objects[i];
            var box = item.Table.At(item.Table.Levels).Box;
            (_order[i], _keys[i]) = (i, box.IsEmpty ? 0 : ((item.Map * box.Centre) - _view.Position).LengthSquared());
        }

        _keys.AsSpan(0, count).Sort(_order.AsSpan(0, count));
    }

    private void FillStrip(int index)
    {
        // One strip too many is enough to begin again.
        if (_isOverBudget)
        {
            return;
        }

        var (strip, count) = (_strips[index], _objects.Count);
        strip.Begin(in _view, _settings, PixelSize, _budget, index * _view.Width / Strips, (index + 1) * _view.Width / Strips);
        for (var place = 0; place < count; place++)
        {
            var item = _objects[_order[place]];
            strip.Add(item);
            _ends[(index * count) + place] = strip.Rows.Count;
            _sharedEnds[(index * count) + place] = strip.Shared.Count;
            _isCut[(index * count) + place] = strip.IsCut;
        }

        if (Interlocked.Add(ref _found, strip.Rows.Count) > _budget || strip.IsOverBudget)
        {
            _isOverBudget = true;
        }
    }

    /// <summary>Puts together what several strips have found, each instance once.</summary>
    private void Merge()
    {
        _shared.Clear();
        _seen.Clear();
        (Cost, InstanceCount) = (default, 0);
        var count = _objects.Count;
        for (var place = 0; place < count; place++)
        {
            for (var index = 0; index < Strips; index++)
            {
                var strip = _strips[index];
                var start = place == 0 ? 0 : _sharedEnds[(index * count) + place - 1];
                for (var i = start; i < _sharedEnds[(index * count) + place]; i++)
                {
                    if (_seen.Add((place, strip.Shared.Paths[i])))
                    {
                        _shared.Add(strip.Shared, i);
                    }
                }
            }

            _mergedEnds[place] = _shared.Count;
        }

        InstanceCount = _shared.Count;
        foreach (var strip in _strips)
        {
            Cost += strip.Cost;
            InstanceCount += strip.Rows.Count;
        }
    }
}
