using System.CommandLine;
using System.CommandLine.Parsing;
using System.Globalization;
using FractalEngine.Core.Fractals;
using FractalEngine.Core.Scenes;
using FractalEngine.Parsing.Assets;
using FractalEngine.Parsing.Scenes;

namespace FractalEngine.App.Commands;

/// <summary>Arguments and options that several commands have.</summary>
internal sealed class SharedOptions
{
    /// <summary>The file that a command works on.</summary>
    public Argument<string> File { get; } = FileArgument("A mesh (.obj), a fractal (.fdo) or a scene (.sdo).");

    /// <summary>Lifts the restriction of <see cref="AssetFolder"/>.</summary>
    public Option<bool> AllowOutside { get; } = new("--allow-outside")
    {
        Description = "Let files name others outside their folder.",
    };

    /// <summary>How transformations are composed.</summary>
    public Option<Composition?> Composition { get; } = new("--composition")
    {
        Description = "How the transformations of a fractal are composed, whatever its file says: affine or componentwise.",
        HelpName = "affine|componentwise",
        CustomParser = result => ParseWord(
            result, ("affine", Core.Fractals.Composition.Affine), ("componentwise", Core.Fractals.Composition.Componentwise)),
    };

    /// <summary>Adds what every command that loads a file has.</summary>
    /// <param name="command">The command.</param>
    /// <param name="hasComposition">Whether it matters to the command how fractals are composed.</param>
    public void AddTo(Command command, bool hasComposition = true)
    {
        command.Add(File);
        command.Add(AllowOutside);
        if (hasComposition)
        {
            command.Add(Composition);
        }
    }

    /// <summary>A file to read. What looks like an option is no file: <c>./-x.obj</c> names one that does.</summary>
    public static Argument<string> FileArgument(string description) => new("FILE")
    {
        Description = description,
        Validators =
        {
            result =>
            {
                if (result.Tokens is [{ Value: var path }] && (path.Length == 0 || path[0] == '-'))
                {
                    result.AddError(path.Length == 0 ? "the name of the file is empty" : $"unknown option '{path}'");
                }
            },
        },
    };

    /// <summary>How to load the file.</summary>
    public LoadOptions LoadOptions(ParseResult result) => new()
    {
        AllowOutsideFiles = result.GetValue(AllowOutside),
        Composition = result.CommandResult.Command.Options.Contains(Composition) ? result.GetValue(Composition) : null,
    };

    /// <summary>Where a command writes to.</summary>
    public static Option<string> OutputOption(string extension, string description) => new("--output", "-o")
    {
        Description = description,
        HelpName = $"FILE{extension}",
        Required = true,
        Validators =
        {
            result =>
            {
                if (result.Tokens is [{ Value: var path }] && !path.EndsWith(extension, StringComparison.OrdinalIgnoreCase))
                {
                    result.AddError($"--output '{path}' must end in {extension}");
                }
            },
        },
    };

    /// <summary>One of a few words.</summary>
    public static T? ParseWord<T>(ArgumentResult result, params (string Word, T Value)[] words)
        where T : struct =>
        ParseWords(result, words) is [var value] ? value : null;

    /// <summary>Any of a few words.</summary>
    public static T[] ParseWords<T>(ArgumentResult result, params ReadOnlySpan<(string Word, T Value)> words)
    {
        var values = new List<T>();
        foreach (var token in result.Tokens)
        {
            var countBefore = values.Count;
            foreach (var (word, value) in words)
            {
                if (token.Value == word)
                {
                    values.Add(value);
                }
            }

            if (values.Count == countBefore)
            {
                result.AddError(
                    $"{NameOf(result)}: expected one of {string.Join(", ", words.ToArray().Select(item => item.Word))}, not '{token.Value}'");
                return [];
            }
        }

        return [.. values];
    }

    /// <summary>A whole number within bounds.</summary>
    public static Func<ArgumentResult, long?> ParseInteger(long min, long max) => result =>
    {
        if (result.Tokens is [{ Value: var token }]
            && long.TryParse(token, NumberStyles.AllowLeadingSign, CultureInfo.InvariantCulture, out var number)
            && number >= min && number <= max)
        {
            return number;
        }

        result.AddError($"{NameOf(result)}: expected a whole number from {min} to {max}");
        return null;
    };

    /// <summary>A decimal number between two others.</summary>
    public static Func<ArgumentResult, double?> ParseNumber(double min, double max) => result =>
    {
        if (result.Tokens is [{ Value: var token }]
            && double.TryParse(token, NumberStyles.Float, CultureInfo.InvariantCulture, out var number)
            && number >= min && number <= max)
        {
            return number;
        }

        result.AddError(string.Create(CultureInfo.InvariantCulture, $"{NameOf(result)}: expected a number from {min} to {max}"));
        return null;
    };

    private static string NameOf(ArgumentResult result) => result.Parent is OptionResult option ? option.Option.Name : result.Argument.Name;

    /// <summary>How what is nearest is found.</summary>
    public static Option<ColliderKind?> ColliderOption(string description)
    {
        (string Word, ColliderKind Kind)[] words =
            [.. Enum.GetValues<ColliderKind>().Select(kind => (SceneParser.GetColliderName(kind), kind))];
        return new("--collider")
        {
            Description = description,
            HelpName = string.Join('|', words.Select(item => item.Word)),
            CustomParser = result => ParseWord(result, words),
        };
    }

    /// <summary>The projection of a picture.</summary>
    public static Option<Projection?> ProjectionOption() => new("--projection")
    {
        Description = "The projection, whatever the scene says: perspective or orthographic.",
        HelpName = "perspective|orthographic",
        CustomParser = result => ParseWord(
            result, ("perspective", Core.Scenes.Projection.Perspective), ("orthographic", Core.Scenes.Projection.Orthographic)),
    };

    /// <summary>The size of a picture or window in pixels.</summary>
    public static Option<(int Width, int Height)?> ResolutionOption() => new("--resolution")
    {
        Description = "Width and height in pixels; 1280x720 unless stated.",
        HelpName = "WIDTHxHEIGHT",
        CustomParser = result =>
        {
            if (result.Tokens is [{ Value: var token }] && token.Split('x') is [var width, var height]
                && int.TryParse(width, NumberStyles.None, CultureInfo.InvariantCulture, out var w) && w is > 0 and <= 1_000_000
                && int.TryParse(height, NumberStyles.None, CultureInfo.InvariantCulture, out var h) && h is > 0 and <= 1_000_000)
            {
                return (w, h);
            }

            result.AddError($"{NameOf(result)}: expected a size such as 1280x720");
            return null;
        },
    };
}
