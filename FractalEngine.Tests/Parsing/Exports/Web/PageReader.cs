using System.Globalization;
using System.IO.Compression;
using System.Text;
using System.Text.Json;
using System.Text.RegularExpressions;
using FractalEngine.Core.Maths;
using FractalEngine.Parsing.Assets;
using FractalEngine.Parsing.Exports;
using FractalEngine.Parsing.Exports.Web;
using FractalEngine.Tests.Support;

namespace FractalEngine.Tests.Parsing.Exports.Web;

/// <summary>Reads what an exported page holds, and walks its levels as the viewer does. It shares no code with the writer.</summary>
internal sealed partial class PageReader
{
    private readonly JsonElement _root;

    private PageReader(byte[] page)
    {
        Text = Encoding.UTF8.GetString(page);
        var data = Convert.FromBase64String(DataPattern().Match(Text).Groups[1].Value);
        using var inflate = new DeflateStream(new MemoryStream(data), CompressionMode.Decompress);
        _root = JsonDocument.Parse(inflate).RootElement;
    }

    /// <summary>The whole page.</summary>
    public string Text { get; }

    public JsonElement this[string name] => _root.GetProperty(name);

    public static byte[] Export(string path, LoadOptions? options = null, ExportSettings? settings = null)
    {
        options = (options ?? new()) with { IsStaged = true };
        using var stream = new MemoryStream();
        new WebExport().Write(AssetLoader.Load(path, options).Scene, (settings ?? new()) with { Load = options }, stream);
        return stream.ToArray();
    }

    public static PageReader Of(string path, LoadOptions? options = null) => new(Export(path, options));

    /// <summary>Expands a fractal of the page into the maps of its instances, by rows.</summary>
    /// <param name="index">Number of the fractal.</param>
    public List<double[][]> Expand(int index)
    {
        var fractal = this["fractals"][index];
        return Expand(fractal.GetProperty("shape"), Numbers(fractal.GetProperty("values")));
    }

    /// <summary>Expands a fractal at one of the values of a number that changes no levels.</summary>
    public List<double[][]> Expand(JsonElement number, int sample)
    {
        var one = number.GetProperty("fractals")[0];
        var fractal = this["fractals"][one.GetProperty("fractal").GetInt32()];
        var values = Numbers(fractal.GetProperty("values"));
        var changing = Numbers(one.GetProperty("changing"));
        var sampled = Numbers(one.GetProperty("values"));
        for (var i = 0; i < changing.Length; i++)
        {
            values[(int)changing[i]] = sampled[(sample * changing.Length) + i];
        }

        return Expand(fractal.GetProperty("shape"), values);
    }

    public static double[] Numbers(JsonElement array) => [.. array.EnumerateArray().Select(static one => one.GetDouble())];

    private static List<double[][]> Expand(JsonElement shape, double[] values)
    {
        var start = shape.GetProperty("start");
        var maps = new List<double[][]>();
        Visit(Resolve(start[0].GetInt64(), Unsigned(start[1]), start[2].GetInt64()), NaiveFractal.MapOf(Transformation.Identity));
        return maps;

        JsonElement LevelAt(long level)
        {
            var run = shape.GetProperty("runs").EnumerateArray().Last(run => run[0].GetInt64() <= level);
            return shape.GetProperty("levels")[(int)(run[2].GetInt32() + ((level - run[0].GetInt64()) % run[3].GetInt32()))];
        }

        (long Level, ulong Way, long Size) Enter((long Level, ulong Way, long Size) place, JsonElement[] child)
        {
            var step = child[3].GetInt64();
            var level = step < 0 ? -1 - step : place.Level - step;
            return child.Length == 5 ? (level, 0, 0)
                : (level, unchecked((place.Way * Unsigned(child[5])) + Unsigned(child[6])), place.Size + child[7].GetInt64());
        }

        (long Level, ulong Way, long Size) Resolve(long firstLevel, ulong way, long size)
        {
            var place = (Level: firstLevel, Way: way, Size: size);
            while (LevelAt(place.Level)[3] is { ValueKind: JsonValueKind.Array } choice)
            {
                var index = choice.GetArrayLength() > 1 ? Draw(choice, place.Level, place.Way)
                    : place.Size <= choice[0].GetInt64() ? 0 : 1;
                place = Enter(place, ChildrenOf(LevelAt(place.Level))[index]);
            }

            return place;
        }

        List<JsonElement[]> ChildrenOf(JsonElement level)
        {
            var width = shape.GetProperty("levels").EnumerateArray().Any(one => one[3].ValueKind == JsonValueKind.Array) ? 8 : 5;
            return [.. shape.GetProperty("lists")[level[2].GetInt32()].EnumerateArray().Chunk(width)];
        }

        void Visit((long Level, ulong Way, long Size) place, double[][] map)
        {
            var level = LevelAt(place.Level);
            if (level[1].GetInt32() == 1)
            {
                return;
            }

            var children = ChildrenOf(level);
            if (children.Count == 0)
            {
                maps.Add(map);
            }

            foreach (var child in children)
            {
                var next = Enter(place, child);
                double[][] own = [.. values.Skip(12 * child[0].GetInt32()).Take(12).Chunk(4)];
                Visit(child.Length == 5 ? next : Resolve(next.Level, next.Way, next.Size), NaiveFractal.Compose(map, own));
            }
        }
    }

    private static int Draw(JsonElement choice, long level, ulong way)
    {
        var by = choice[2];
        if (by.ValueKind == JsonValueKind.Array)
        {
            var (top, lowest, period) = (by[0].GetInt64(), by[1].GetInt64(), by[2].GetInt64());
            var number = ((top - lowest) / period) - ((level - lowest) / period);
            if (by[3].GetArrayLength() > 0)
            {
                return by[3].EnumerateArray().Count(first => first.GetInt64() <= number) - 1;
            }

            way = Ordinal(number);
        }

        var hash = HashMixing.Mix(unchecked(way + Unsigned(choice[1])));
        ulong[] ends = [.. choice[0].EnumerateArray().Select(Unsigned)];
        return Math.Min(ends.TakeWhile(end => hash >= end).Count(), ends.Length - 1);
    }

    // The way of a number and a 0, as the format of ways tells.
    private static ulong Ordinal(long number) => unchecked((((ulong)number + 1) * 6364136223846793005) + 1);

    private static ulong Unsigned(JsonElement text) => ulong.Parse(text.GetString()!, CultureInfo.InvariantCulture);

    [GeneratedRegex("id=\"data\">([^<]*)<")]
    private static partial Regex DataPattern();
}
