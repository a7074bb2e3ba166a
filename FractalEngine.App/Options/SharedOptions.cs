using System.Collections.Immutable;
using System.CommandLine;
using System.Globalization;
using FractalEngine.App.Shell;
using FractalEngine.Core.Colliders;
using FractalEngine.Core.Fractals.Descriptions;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes.Cameras;
using FractalEngine.Parsing.Assets;
using FractalEngine.Parsing.Assets.References;
using FractalEngine.Parsing.Fdo;
using FractalEngine.Parsing.Text;

namespace FractalEngine.App.Options;

/// <summary>Arguments and options that several commands have in common.</summary>
internal sealed class SharedOptions
{
    /// <summary>Largest width and height of an image that the command line takes, in pixels; drivers allow less.</summary>
    public const int MaxImageSide = 1_000_000;

    /// <summary>Name of the option for seeds.</summary>
    public const string SeedName = "--seed";

    /// <summary>Largest time of the physics before an image, in seconds.</summary>
    public const double MaxTime = 3600;

    /// <summary>Width and height of an image or window unless <c>--resolution</c> is given, in pixels.</summary>
    public static (int Width, int Height) DefaultResolution => (1280, 720);

    public Argument<string> File { get; } = FileArgument(
        "A mesh (.obj, .obj.gz, .ply, .stl, .glb, .gltf), a fractal (.fdo) or a scene (.sdo); "
            + "'-' reads a scene or a fractal from the standard input.");

    /// <summary>The option that lifts the restriction of <see cref="AssetFolder"/>.</summary>
    public Option<bool> AllowOutside { get; } = Flag("--allow-outside", "Allow files to refer to files outside their folder.");

    /// <summary>The option that selects how transformations are composed.</summary>
    public Option<Composition?> Composition { get; } = WordOption.Single(
        "--composition", "How to compose the transformations of fractals, overriding their files.",
        ("affine", Core.Fractals.Descriptions.Composition.Affine), ("componentwise", Core.Fractals.Descriptions.Composition.Componentwise));

    /// <summary>The option that sets named numbers of fractals.</summary>
    public Option<string[]> Values { get; } = new("--set")
    {
        Description = "Set a number that a fractal file declares by name; repeatable.",
        HelpName = "NAME=VALUE",
        Arity = ArgumentArity.OneOrMore,
        AllowMultipleArgumentsPerToken = false,
    };

    /// <summary>The option that makes other fractals by chance.</summary>
    public Option<int?> Seed { get; } = NumberOption.Integer(
        SeedName, "N", 0, Choice.MaxSeed, "Seed of fractals by chance, overriding their files, and of a traced image (default: 0).");

    private readonly Option<Handedness?> _handed = WordOption.Single(
        "--from-handed", "Handedness of the coordinates of a mesh or fractal (default: right for meshes, left for fractals).",
        ("right", Handedness.Right), ("left", Handedness.Left));

    private readonly Option<Vector?> _up = WordOption.Single(
        "--from-up", "The axis of a mesh or fractal that points up (default: y).", ("y", Vector.Zero), ("z", new Vector(90, 0, 0)));

    private readonly Option<double?> _unit = NumberOption.Positive(
        "--from-unit", "LENGTH", "Length of the unit of a mesh or fractal, in scene units (default: 1).");

    /// <summary>Adds the input file and the options of loading to a command.</summary>
    public void AddTo(Command command, bool hasComposition = true)
    {
        command.Add(File);
        command.Add(AllowOutside);
        if (hasComposition)
        {
            command.Add(Values);
            command.Add(Composition);
            command.Add(Seed);
            AddAll(command, _handed, _up, _unit);
        }
    }

    /// <summary>Adds options to a command, in the order of the help text.</summary>
    public static void AddAll(Command command, params Option[] options)
    {
        foreach (var option in options)
        {
            command.Add(option);
        }
    }

    /// <summary>Returns the load options that the command line asks for.</summary>
    /// <exception cref="UsageException">A named number is set to no number.</exception>
    public LoadOptions LoadOptions(ParseResult result)
    {
        var options = new LoadOptions { AllowOutsideFiles = result.GetValue(AllowOutside) };
        return !result.CommandResult.Command.Options.Contains(Composition) ? options : options with
        {
            Composition = result.GetValue(Composition),
            Seed = result.GetValue(Seed),
            Handedness = result.GetValue(_handed),
            Placement = new(Vector.Zero, result.GetValue(_up) ?? Vector.Zero, (result.GetValue(_unit) ?? 1) * Vector.One),
            Values = ImmutableDictionary<string, double>.Empty.SetItems((result.GetValue(Values) ?? []).Select(ParseValue)),
        };
    }

    private static KeyValuePair<string, double> ParseValue(string text)
    {
        if (text.Split('=', 2) is not [{ Length: > 0 } name, var number])
        {
            throw new UsageException($"--set '{text}': expected NAME=VALUE, such as angle=30");
        }

        try
        {
            return new(name.Trim(), NumberExpression.Compute(number));
        }
        catch (SourceException exception)
        {
            throw new UsageException($"--set '{text}': {exception.Diagnostic.Message}");
        }
    }

    /// <summary>Creates an argument for an input file. Names that begin with a dash need the prefix <c>./</c>.</summary>
    public static Argument<string> FileArgument(string description) => new("FILE")
    {
        Description = description,
        Validators =
        {
            result =>
            {
                if (result.Tokens is [{ Value: var path }] && path != StandardInput.Name && (path.Length == 0 || path[0] == '-'))
                {
                    result.AddError(path.Length == 0 ? "the name of the file is empty" : $"unknown option '{path}'");
                }
            },
        },
    };

    /// <summary>Creates an option without a value.</summary>
    public static Option<bool> Flag(string name, string description) => new(name) { Description = description };

    /// <summary>Creates the option that leaves traced images as they are.</summary>
    public static Option<bool> NoDenoiseOption() => Flag("--no-denoise", "Leave the noise of traced images as it is.");

    /// <summary>Creates an option for a text, which the command parses.</summary>
    /// <param name="name">The name with its dashes.</param>
    /// <param name="helpName">The placeholder of the value in the help text.</param>
    /// <param name="description">The sentence in the help text.</param>
    public static Option<string?> TextOption(string name, string helpName, string description) =>
        new(name) { Description = description, HelpName = helpName };

    /// <summary>Creates the required option for an output file.</summary>
    /// <param name="extension">The extension that the file name must have, with its dot; several are separated by <c>|</c>.</param>
    /// <param name="description">The sentence in the help text.</param>
    /// <param name="isText">Whether <c>-</c> stands for the standard output.</param>
    public static Option<string> OutputOption(string extension, string description, bool isText = true)
    {
        var option = FileOption("--output", extension, description, isText);
        option.Aliases.Add("-o");
        option.Required = true;
        return option;
    }

    /// <summary>Creates an option for one more file to write.</summary>
    /// <inheritdoc cref="OutputOption"/>
    public static Option<string> FileOption(string name, string extension, string description, bool isText = false) => new(name)
    {
        Description = isText ? $"{description} '-' is the standard output." : description,
        HelpName = $"FILE{extension}",
        Validators =
        {
            result =>
            {
                if (result.Tokens is [{ Value: var path }]
                    && !extension.Split('|').Any(known => path.EndsWith(known, StringComparison.OrdinalIgnoreCase))
                    && !(isText && path == StandardInput.Name))
                {
                    result.AddError($"{name} '{path}' must end in {extension.Replace("|", " or ", StringComparison.Ordinal)}");
                }
            },
        },
    };

    /// <summary>Creates the option that selects the collider of closest-point queries.</summary>
    public static Option<ColliderKind?> ColliderOption(string description) => WordOption.Single(
        "--collider", description, [.. ColliderNames.All.Select(static known => (known.Name, known.Kind))]);

    public static Option<Projection?> ProjectionOption() => WordOption.Single(
        "--projection", "Projection, overriding the scene's.",
        ("perspective", Projection.Perspective), ("orthographic", Projection.Orthographic));

    public static Option<string?> BackgroundOption() => TextOption(
        "--background", "transparent|\"(r, g, b)\"",
        "Colour behind the scene, sRGB from 0 to 1, overriding the scene's; or transparent.");

    /// <summary>Creates the option for the physics time at which a scene is shown, in seconds.</summary>
    public static Option<double?> TimeOption() => NumberOption.Decimal(
        "--time", "SECONDS", 0, MaxTime, "Simulate the physics for this time first (default: 0).");

    /// <summary>Creates the option for the size of an image or window in pixels.</summary>
    /// <param name="fallback">The size without the option, as the help text names it.</param>
    public static Option<(int Width, int Height)?> ResolutionOption(string fallback = "1280x720") => new("--resolution")
    {
        Description = $"Width and height in pixels (default: {fallback}).",
        HelpName = "WIDTHxHEIGHT",
        CustomParser = result =>
        {
            if (result.Tokens is [{ Value: var token }] && token.Split('x') is [var widthText, var heightText]
                && TryParseSide(widthText, out var width) && TryParseSide(heightText, out var height))
            {
                return (width, height);
            }

            result.AddError("--resolution: expected a size such as 1280x720");
            return null;
        },
    };

    private static bool TryParseSide(string text, out int side) =>
        int.TryParse(text, NumberStyles.None, CultureInfo.InvariantCulture, out side) && side is > 0 and <= MaxImageSide;
}
