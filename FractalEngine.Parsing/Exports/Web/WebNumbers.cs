using System.Globalization;
using System.Text.Json;
using FractalEngine.Core;
using FractalEngine.Core.Scenes;
using FractalEngine.Parsing.Assets;
using FractalEngine.Parsing.Fdo;
using FractalEngine.Parsing.Text;

namespace FractalEngine.Parsing.Exports.Web;

/// <summary>
/// The named numbers of a page's fractals, as sliders: each fractal at several values of each number, with all others as they are.
/// </summary>
/// <remarks>
/// Between two values a page goes straight from one map to the next, which is off by about an eighth of the square of the angle, in
/// radians, by which a step turns. Fractals that have other levels at other values jump from one to the next.
/// </remarks>
/// <param name="models">The models of the page.</param>
/// <param name="levels">Their levels, in the same order.</param>
/// <param name="options">How the models were loaded.</param>
/// <param name="losses">Receives a sentence for each number that can't be a slider.</param>
/// <param name="progress">Told the part of all values that is done; null for nobody.</param>
internal sealed class WebNumbers(
    IReadOnlyList<Model> models, IReadOnlyList<WebLevels> levels, LoadOptions options, ISet<string> losses, IProgress<double>? progress)
{
    // Sliders stop at these values alone where levels differ.
    private const int MaxSamples = 17;

    private readonly Dictionary<string, (double Value, double From, double To)> _numbers = [];
    private readonly AssetCache _cache = new();

    /// <summary>Writes the numbers as a JSON array.</summary>
    /// <param name="json">Receives the array.</param>
    /// <returns>The number of sliders.</returns>
    public int Write(Utf8JsonWriter json)
    {
        var paths = models.OfType<FractalModel>().Where(static model => !model.NumberNames.IsEmpty || model.SourcePath is not null)
            .Select(static model => model.SourcePath).OfType<string>().Distinct().ToArray();
        Array.ForEach(paths, FindNumbers);
        var (count, done) = (0, 0);
        json.WriteList("numbers", _numbers, entry =>
        {
            if (Sample(paths, entry.Key, entry.Value) is { } samples)
            {
                json.WriteObject(null, () => Write(json, entry.Key, entry.Value, samples));
                count++;
            }

            progress?.Report((double)++done / _numbers.Count);
        });
        return count;
    }

    private void FindNumbers(string path)
    {
        if (!path.EndsWith(".fdo", StringComparison.OrdinalIgnoreCase))
        {
            return;
        }

        var source = options.Text ?? (options.EditedTexts.TryGetValue(path, out var edited) ? new(path, edited)
            : SourceText.Read(path, Path.GetFileName(path), ParsingLimits.DescriptionBytes.Value));
        foreach (var number in FractalNumber.FindAll(source).Where(static one => one.Role == FractalNumberRole.Named))
        {
            var value = options.Values.TryGetValue(number.Name, out var set) ? set : number.Value;
            var reach = Math.Max(1, Math.Abs(value));
            _numbers.TryAdd(number.Name, (value, number.Range?.From ?? value - reach, number.Range?.To ?? value + reach));
        }
    }

    /// <summary>Loads the fractals at each value of a number; null where one can't be loaded at some value.</summary>
    private List<(int Model, WebLevels[] Samples)>? Sample(
        string[] paths, string name, (double Value, double From, double To) number)
    {
        var samples = new List<(int Model, WebLevels[] Samples)>();
        try
        {
            if (!double.IsFinite(number.To - number.From))
            {
                throw new FractalEngineException("it would go from end to end of all numbers");
            }

            foreach (var path in paths)
            {
                var loaded = Enumerable.Range(0, MaxSamples).Select(i => PartsAt(path, name, ValueAt(number, i))).ToArray();
                if (loaded[0].Length == 0)
                {
                    continue;
                }

                int[] shown = [.. Enumerable.Range(0, models.Count).Where(index => models[index].SourcePath == path)];
                if (loaded.Any(parts => parts.Length != shown.Length))
                {
                    throw new FractalEngineException("its meshes are others");
                }

                samples.AddRange(shown.Select((model, part) => (model, loaded.Select(parts => parts[part]).ToArray())));
            }
        }
        catch (FractalEngineException exception)
        {
            losses.Add($"the number '{name}' is no slider, since its fractal can't be made at each value: {exception.Message}");
            return null;
        }

        return samples;
    }

    private WebLevels[] PartsAt(string path, string name, double value)
    {
        var file = AssetLoader.Load(path, options with { Values = options.Values.SetItem(name, value) }, null, _cache);
        return file.Scene.Objects[0].Model is FractalModel model && model.NumberNames.Contains(name)
            ? [.. model.Parts.Cast<FractalModel>().Select(static part => new WebLevels(part.Fractal))] : [];
    }

    private static double ValueAt((double Value, double From, double To) number, int sample) =>
        number.From + ((double)sample / (MaxSamples - 1) * (number.To - number.From));

    private void Write(
        Utf8JsonWriter json, string name, (double Value, double From, double To) number, List<(int Model, WebLevels[] Samples)> samples)
    {
        json.WriteString("name", name);
        json.WriteNumbers("range", [number.Value, number.From, number.To, MaxSamples]);
        json.WriteObjects("fractals", samples, sample =>
        {
            json.WriteNumber("fractal", sample.Model);
            var present = levels[sample.Model];
            if (sample.Samples.All(one => one.Shape == present.Shape))
            {
                WriteValues(json, present.Values, sample.Samples);
            }
            else
            {
                json.WriteObjects("others", sample.Samples, one => WebScene.WriteLevels(json, one));
            }
        });
    }

    /// <summary>Writes the numbers that differ at any value: which ones, and for each value all of them.</summary>
    private static void WriteValues(Utf8JsonWriter json, IReadOnlyList<double> values, WebLevels[] samples)
    {
        int[] changing =
        [
            .. Enumerable.Range(0, values.Count).Where(index => samples.Any(one => Rounded(one.Values[index]) != Rounded(values[index]))),
        ];
        json.WriteNumbers("changing", changing.Select(static index => (double)index));
        json.WriteList(
            "values", samples.SelectMany(sample => changing.Select(index => Rounded(sample.Values[index]))),
            value => json.WriteRawValue(value));
    }

    // What is drawn between values is not exact, and needs no more digits.
    private static string Rounded(double value) => value.ToString("G6", CultureInfo.InvariantCulture);
}
