using System.Globalization;

namespace FractalEngine.Core.Fractals;

/// <summary>A path of maps from a whole fractal down to an instance, as queries return it. Paths share their beginnings.</summary>
/// <param name="Outer">The path to the map; null where it is the outermost.</param>
/// <param name="Index">Index of the map in its set, or of the call in its recursive.</param>
public sealed record MapPath(MapPath? Outer, int Index)
{
    /// <summary>Lists the indices, the outermost first, as <see cref="Fractal.Follow"/> takes them.</summary>
    public int[] ToArray()
    {
        var indices = new List<int>();
        for (var step = this; step is not null; step = step.Outer)
        {
            indices.Add(step.Index);
        }

        indices.Reverse();
        return [.. indices];
    }

    /// <summary>Formats the path as the window shows it: the indices, the outermost first, with points between them.</summary>
    public override string ToString() =>
        string.Join('.', ToArray().Select(static index => index.ToString(CultureInfo.InvariantCulture)));
}
