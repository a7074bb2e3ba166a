using System.Collections.Immutable;
using System.Text;
using FractalEngine.Core;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Generation;
using FractalEngine.Core.Maths;
using FractalEngine.Parsing.Text;

namespace FractalEngine.Parsing.Fdo.Writing;

/// <summary>
/// Writes fractals in the language of fractal files (paper §4.2.2). <see cref="FractalParser"/> reads the text back to an equal
/// description, every number bit for bit.
/// </summary>
/// <remarks>
/// The text is about as long as a person would write it. Every vector is declared once. Each set has one transformation function, whose
/// outputs are parameters where the transformations of the set differ.
/// </remarks>
public sealed class FractalWriter
{
    // The letters of the paper and of the examples; 'v' declares a vector.
    private const string FunctionLetters = "turspqw";

    private readonly StringBuilder _text = new();
    private readonly FractalVectors _vectors = new();
    private readonly Dictionary<TransformationSet, FractalSetForm> _forms = new(ReferenceEqualityComparer.Instance);
    private readonly Dictionary<string, string> _functionNames = [];
    private readonly Dictionary<string, string> _matrixNames = [];
    private readonly HashSet<FractalStep> _collectedSteps = new(ReferenceEqualityComparer.Instance);
    private readonly List<FractalSetForm> _orderedForms = [];
    private long _setCharacters;
    private int _recursiveCount;
    private int _objectCount;
    private int _baseCount;

    private FractalWriter()
    {
    }

    /// <summary>Returns the text of a fractal file.</summary>
    /// <param name="description">What the fractal makes of base meshes, and its composition.</param>
    /// <param name="baseFiles">
    /// For each base mesh the name of its file, relative to the fractal file, or one of the <see cref="BaseShapes"/>.
    /// </param>
    /// <exception cref="FractalEngineException">
    /// The language can't express the fractal: a scale is singular, steps follow an infinite repetition, what has choices or ends by size
    /// has a placement, or a limit is exceeded.
    /// </exception>
    /// <remarks>Time and memory are proportional to the text, which has at most 16 MiB.</remarks>
    public static string Write(FractalDescription description, params ImmutableArray<string> baseFiles) =>
        Write(description, ImmutableArray.CreateRange(baseFiles, static file => new BaseReference(file, 0)));

    /// <summary>Returns the text of a fractal file whose base meshes may have materials of the file.</summary>
    /// <param name="description">What the fractal makes of base meshes, and its composition.</param>
    /// <param name="bases">The base meshes, with names of files as strings would be.</param>
    /// <exception cref="FractalEngineException">As there.</exception>
    public static string Write(FractalDescription description, ImmutableArray<BaseReference> bases)
    {
        foreach (var name in bases.SelectMany(static one => new[] { one.File, one.Material?.File, one.Material?.Name }).OfType<string>())
        {
            FileReference.RequireQuotable(name);
        }

        RequireExpressible(description);
        var text = new FractalWriter().WriteText(description, bases);
        RequireLength(Encoding.UTF8.GetByteCount(text));
        RequireReadable(text);
        return text;
    }

    private static void RequireExpressible(FractalDescription description)
    {
        // Deeper nesting is refused here, before any recursion over the steps.
        var nesting = description.Steps.Select(step => step.NestingDepth).DefaultIfEmpty().Max();
        if (nesting > FractalLimits.Nesting.Value)
        {
            throw Fault(ErrorKind.Limit, $"it has more than the limit of {FractalLimits.Nesting.Value} repetitions inside each other");
        }

        var infinite = description.Steps.ToList().FindLastIndex(step => step.LevelCount is null);
        if (description.Steps.Take(infinite).Any(step => step is Repetition))
        {
            throw Fault(ErrorKind.Input, "an infinite repetition can't be repeated again");
        }
    }

    /// <summary>Refuses a text that is longer than files may be.</summary>
    internal static void RequireLength(long length)
    {
        if (length > ParsingLimits.DescriptionBytes.Value)
        {
            throw Fault(ErrorKind.Limit, $"its text has more than the limit of {ParsingLimits.DescriptionBytes.Value} bytes");
        }
    }

    /// <summary>The parser decides about all limits and scales, so that both never disagree.</summary>
    private static void RequireReadable(string text)
    {
        try
        {
            FractalParser.Parse(new SourceText("fractal.fdo", text));
        }
        catch (SourceException exception)
        {
            throw Fault(exception.Kind, exception.Diagnostic.Message, exception);
        }
    }

    /// <summary>Makes the error of a fractal that the language can't express.</summary>
    internal static FractalEngineException Fault(ErrorKind kind, string fault, Exception? innerException = null) =>
        new(kind, $"the fractal can't be written as a file: {fault}", innerException);

    private string WriteText(FractalDescription description, ImmutableArray<BaseReference> bases)
    {
        foreach (var part in description.AllParts().OfType<SteppedPart>())
        {
            CollectSets(part.Steps);
        }

        if (description.Composition == Composition.Componentwise)
        {
            AppendLine("composition componentwise");
            AppendLine("");
        }

        WriteVectors("position", "positions", form => form.Vectors(FractalSetForm.Position));
        WriteVectors("rotation in degrees", "rotations in degrees", form => form.Vectors(FractalSetForm.Rotation));
        WriteVectors("scale", "scales", form => form.Vectors(FractalSetForm.Scale));
        AppendLine(_vectors.Count > 0 ? "" : null);
        var names = new List<string>();
        foreach (var (file, material) in bases.Select(static one => (one.File, one.Material)))
        {
            names.Add(NextName("x", ref _baseCount));
            var surface = material is null ? "" : $" material \"{material.File}\" \"{material.Name}\"";
            AppendLine((BaseShapes.TryFind(file, out _) ? $"{names[^1]}. {file}" : $"{names[^1]}. \"{file}\"") + surface);
        }

        new FractalPartWriter(this, names).Write(description.Parts);
        var result = WriteSteps(description.Steps, names[^1]);
        AppendLine($"<$>. {result}");
        return _text.ToString();
    }

    /// <summary>Finds all sets in the order of their use in the text: innermost first, each object once.</summary>
    private void CollectSets(ImmutableArray<FractalStep> steps)
    {
        foreach (var step in steps.Reverse())
        {
            if (!_collectedSteps.Add(step))
            {
                continue;
            }

            switch (step)
            {
                case TransformationSet { IsPlacement: true }:
                    throw Fault(
                        ErrorKind.Input,
                        "it is moved, and a file would count that as a level, with other choices or ends: place it in a scene");
                case TransformationSet set:
                    var form = new FractalSetForm(set);
                    _forms.Add(set, form);
                    _orderedForms.Add(form);
                    break;
                case Repetition repetition:
                    CollectSets(repetition.Round);
                    break;
            }
        }
    }

    private void WriteVectors(string name, string pluralName, Func<FractalSetForm, IEnumerable<Vector>> select)
    {
        var first = _vectors.Count + 1;
        var lines = _orderedForms.SelectMany(select).Where(_vectors.Add)
            .Select(static vector => FormattableString.Invariant($"v {vector.X:R} {vector.Y:R} {vector.Z:R}")).ToList();
        if (lines.Count > 0)
        {
            var separator = lines.Count == 2 ? "and" : "to";
            AppendLine(lines.Count == 1 ? $"# {first}: {name}." : $"# {first} {separator} {_vectors.Count}: {pluralName}.");
            lines.ForEach(AppendLine);
        }
    }

    /// <summary>Writes the declarations that some steps over a base need.</summary>
    /// <param name="steps">Outermost first.</param>
    /// <param name="baseName">Name of the declared object that the steps apply to.</param>
    /// <returns>Object that the steps make of the base, as written behind the name of a declaration.</returns>
    internal string WriteSteps(ImmutableArray<FractalStep> steps, string baseName)
    {
        var sets = new List<string>();
        var inner = baseName;
        foreach (var step in steps.Reverse())
        {
            if (step is TransformationSet set)
            {
                sets.Add(FormatSet(_forms[set]));
                continue;
            }

            var repetition = (Repetition)step;
            if (sets.Count > 0 || inner != baseName)
            {
                // A recursive needs a name for what it is applied to.
                baseName = NextObjectName();
                AppendLine($"{baseName}. {FormatObject(sets, inner)}");
                sets.Clear();
            }

            var body = WriteSteps(repetition.Round, baseName);
            var name = NextRecursiveName();
            AppendLine($"{name}<{baseName}>. {body}");
            inner = repetition.Count is { } count ? FormattableString.Invariant($"{name} {count}") : name;
        }

        return FormatObject(sets, inner);
    }

    private static string FormatObject(List<string> sets, string inner) =>
        string.Join(' ', Enumerable.Reverse(sets).Append(inner));

    private string FormatSet(FractalSetForm form)
    {
        var function = form.HasTransformations ? FunctionFor(form) : "";
        var calls = form.Set.HasTransformations
            ? form.Set.Transformations.Select(
                (transformation, i) => FormatCall(form, function, transformation, form.Set.ColourOf(i)))
            : form.Set.Maps.Select((map, i) => FormatMap(map, form.Set.ColourOf(i)));
        var text = $"[{string.Join(", ", calls)}]";
        _setCharacters += text.Length;
        RequireLength(_setCharacters);
        return text;
    }

    private string FormatCall(FractalSetForm form, string function, Transformation transformation, MapColour colour)
    {
        if (!colour.IsNone)
        {
            return $"({FormatVector(transformation.Position)}, {FormatVector(transformation.Rotation)}, "
                + $"{FormatVector(transformation.Scale)}){FormatColour(colour)}";
        }

        if (FractalSetForm.IsIdentity(transformation))
        {
            return "#";
        }

        var arguments = form.Arguments(transformation).Select(vector => FormattableString.Invariant($"{_vectors.NumberOf(vector)}"));
        return $"{function}.{string.Join('.', arguments)}";
    }

    /// <summary>Formats a map with what it mixes into colours: a map of its own that only mixes comes first.</summary>
    internal string FormatMap(AffineMap map, MapColour colour) => colour.IsNone ? MatrixFor(map)
        : $"(#, #, #){FormatColour(colour)} * {MatrixFor(map)}";

    private static string FormatVector(Vector vector) => FormattableString.Invariant($"({vector.X:R}, {vector.Y:R}, {vector.Z:R})");

    private static string FormatColour(MapColour colour) =>
        FormattableString.Invariant($" colour {colour.Colour} {colour.Amount:R}");

    /// <summary>Returns the name of the function that makes the transformations of a set, and declares it if it is new.</summary>
    private string FunctionFor(FractalSetForm form)
    {
        var parameters = form.ParameterNames;
        var outputs = form.Outputs(vector => FormattableString.Invariant($"{_vectors.NumberOf(vector)}"));
        var definition = $"{string.Concat(parameters.Select(parameter => $"{parameter}."))} ({string.Join(", ", outputs)})";
        if (!_functionNames.TryGetValue(definition, out var name))
        {
            var index = _functionNames.Count;
            name = index < FunctionLetters.Length ? $"{FunctionLetters[index]}" : FormattableString.Invariant($"t{index + 1}");
            _functionNames.Add(definition, name);
            AppendLine($"{name}.{definition}");
        }

        return name;
    }

    /// <summary>Returns the call of a map, and declares its matrix if it is new.</summary>
    internal string MatrixFor(AffineMap map)
    {
        var definition = string.Join(' ', new[] { map.Linear.V1, map.Linear.V2, map.Linear.V3, map.Translation });
        if (!_matrixNames.TryGetValue(definition, out var name))
        {
            name = FormattableString.Invariant($"m{_matrixNames.Count + 1}");
            _matrixNames.Add(definition, name);
            AppendLine($"{name}.matrix {definition}");
        }

        return $"{name}.";
    }

    /// <summary>Returns a new name of an object.</summary>
    internal string NextObjectName() => NextName("y", ref _objectCount);

    /// <summary>Returns a new name of a recursive.</summary>
    internal string NextRecursiveName() => NextName("z", ref _recursiveCount);

    private static string NextName(string letter, ref int count)
    {
        count++;
        return count == 1 ? letter : FormattableString.Invariant($"{letter}{count}");
    }

    /// <summary>Appends a line; null for none.</summary>
    internal void AppendLine(string? line)
    {
        if (line is not null)
        {
            _text.Append(line).Append('\n');
            RequireLength(_text.Length);
        }
    }
}
