using System.CommandLine;
using System.Globalization;
using FractalEngine.App.Shell;
using FractalEngine.Core.Fractals.Descriptions;

namespace FractalEngine.App.Commands;

/// <summary>The option <c>--limit NAME=N</c> of all commands. On <c>export</c> a number alone is that of the faces.</summary>
internal sealed class LimitOption : Option<string[]>
{
    private const string ExportName = "export";

    public LimitOption()
        : base("--limit")
    {
        Description = "Change one of the limits that the command 'limits' lists; repeatable. "
            + $"On {ExportName}, N alone is the maximum number of faces (default: {FractalLimits.ExportedFaces.Default}).";
        HelpName = "NAME=N";
        Recursive = true;
        Arity = ArgumentArity.OneOrMore;
        AllowMultipleArgumentsPerToken = false;
    }

    /// <summary>Changes the limits for the whole process.</summary>
    /// <exception cref="UsageException">A value names no limit, or is out of its range.</exception>
    public void Apply(ParseResult result)
    {
        foreach (var value in result.GetValue(this) ?? [])
        {
            var (name, number) = value.Split('=', 2) is [var left, var right] ? (left, right)
                : result.CommandResult.Command.Name == ExportName ? (FractalLimits.ExportedFaces.Name, value)
                : throw new UsageException($"--limit '{value}': expected NAME=N, such as {FractalLimits.Depth.Name}=1000");
            var limit = LimitsCommand.All.FirstOrDefault(limit => limit.Name == name)
                ?? throw new UsageException($"--limit '{name}' is no limit: the command 'limits' lists them");
            limit.Value = long.TryParse(number, NumberStyles.None, CultureInfo.InvariantCulture, out var parsed)
                && parsed >= 1 && parsed <= limit.Maximum
                    ? parsed
                    : throw new UsageException($"--limit {name}: expected a whole number from 1 to {limit.Maximum}");
        }
    }
}
