using System.Globalization;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Maths;

namespace FractalEngine.Parsing.Exports.Web;

/// <summary>The levels of a fractal as a page keeps them: a shape of integers, and the numbers that go into it.</summary>
/// <remarks>
/// Two fractals of one shape differ in numbers only, so that a page can go from one to the other. The numbers are the maps by rows, 12
/// each, then the boxes of levels, 6 each, then what maps add to linear light and the part of it that they keep, 4 each.
/// </remarks>
internal sealed class WebLevels
{
    private readonly FractalLevels _levels;
    private readonly List<double> _values = [];

    /// <summary>Lists the levels of a fractal. Sums composed componentwise have none, and become one level.</summary>
    /// <exception cref="FractalLimitException">Such sums are more than the limit, or bounds don't converge.</exception>
    public WebLevels(Fractal fractal)
    {
        if (fractal.Description.Composition == Composition.Componentwise)
        {
            fractal = new(
                new([new TransformationSet(fractal.Expand(FractalLimits.DrawnInstances.Value))]), fractal.BaseMesh);
        }

        _levels = FractalLevels.Of(fractal);
        var starts = new List<int>();
        foreach (var set in _levels.Sets)
        {
            starts.Add(_values.Count / 12);
            foreach (var map in set.Maps)
            {
                _values.AddRange(TransformRows.Of(map));
            }
        }

        foreach (var level in _levels.Levels)
        {
            var box = level.Box.IsEmpty ? new(Vector.Zero, Vector.Zero) : level.Box;
            Add(box.Centre);
            Add(0.5 * box.Size);
        }

        var tinted = AddTints();
        Shape = WriteShape(starts, tinted, fractal.LevelCount ?? _levels.Start);
    }

    /// <summary>All integers, as JSON.</summary>
    public string Shape { get; }

    /// <summary>All numbers, in the order that the remarks tell.</summary>
    public IReadOnlyList<double> Values => _values;

    /// <summary>Number of different levels.</summary>
    public int Count => _levels.Levels.Length;

    private void Add(Vector v) => _values.AddRange([v.X, v.Y, v.Z]);

    /// <summary>Adds the colours of maps, and returns for each map that has one its number.</summary>
    private Dictionary<(int Set, int Map), int> AddTints()
    {
        var numbers = new Dictionary<(int, int), int>();
        for (var set = 0; set < _levels.Sets.Length; set++)
        {
            for (var map = 0; map < _levels.Sets[set].Colours.Length; map++)
            {
                var tint = Tint.Of(_levels.Sets[set].ColourOf(map));
                numbers.Add((set, map), numbers.Count);
                Add(tint.Added);
                _values.Add(tint.Kept);
            }
        }

        return numbers;
    }

    private string WriteShape(List<int> starts, Dictionary<(int Set, int Map), int> tinted, long levelCount)
    {
        var lists = new Dictionary<string, int>();
        var levels = _levels.Levels.Select(level => Text(
            level.Mesh, level.Box.IsEmpty ? 1 : 0,
            ListOf(level), level.Choice is { } choice ? WriteChoice(choice) : "0")).ToArray();
        var runs = _levels.Runs.Select(static run => Text(run.FirstLevel, run.LevelCount, run.FirstIndex, run.Period));
        var start = Text(_levels.Start, Quote(_levels.StartWay), _levels.StartSize);
        return string.Create(CultureInfo.InvariantCulture, $"{{\"maps\":{_levels.Sets.Sum(static set => set.Maps.Length)},")
            + string.Create(CultureInfo.InvariantCulture, $"\"tints\":{tinted.Count},\"count\":{levelCount},\"start\":{start},")
            + $"\"runs\":{Text([.. runs])},\"lists\":{Text([.. lists.Keys])},\"levels\":{Text(levels)}}}";

        int ListOf(FractalLevel level)
        {
            var text = Text([.. level.Children.SelectMany(child => WriteChild(child, starts, tinted))]);
            lists.TryAdd(text, lists.Count);
            return lists[text];
        }
    }

    /// <summary>
    /// Lists the integers of a child: the map, its rank in the set or −1 for the identity, the size of the set, the levels down or −1 less
    /// a fixed level, and its colour or −1. Where ways or sizes decide, the factor and offset of the way and the size follow.
    /// </summary>
    private IEnumerable<object> WriteChild(LevelChild child, List<int> starts, Dictionary<(int Set, int Map), int> tinted)
    {
        var set = _levels.Sets[child.Set];
        IEnumerable<object> numbers =
        [
            starts[child.Set] + child.Map, set.Maps[child.Map] == AffineMap.Identity ? -1 : child.Map, set.Maps.Length,
            child.FixedLevel is { } level ? -1 - level : child.Down, tinted.GetValueOrDefault((child.Set, child.Map), -1),
        ];
        return HasPicks ? numbers.Concat([Quote(child.Way.Factor), Quote(child.Way.Offset), child.Size]) : numbers;
    }

    private bool HasPicks => _levels.Levels.Any(static level => level.Choice is not null);

    private static string WriteChoice(LevelChoice choice) => choice.MaxSize is { } size ? Text(size) : Text(
        Text([.. choice.Ends.Select(Quote)]), Quote(choice.Seed),
        choice.ByLevel is { } by ? Text(
            by.Top, by.Lowest, by.Period, Text([.. choice.FirstLevels])) : "0");

    // JavaScript reads numbers as doubles, which have 53 bits.
    private static string Quote(ulong number) => string.Create(CultureInfo.InvariantCulture, $"\"{number}\"");

    private static string Text(params object[] items) =>
        $"[{string.Join(',', items.Select(static item => Convert.ToString(item, CultureInfo.InvariantCulture)))}]";
}
