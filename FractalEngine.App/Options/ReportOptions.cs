using System.CommandLine;
using FractalEngine.App.Shell.Reports;

namespace FractalEngine.App.Options;

/// <summary>The options of commands that write a file: how much they tell about it.</summary>
internal sealed class ReportOptions
{
    private readonly Option<bool> _quiet = new("--quiet") { Description = "Do not tell what was written." };
    private readonly Option<bool> _verbose = new("--verbose") { Description = "Also tell how long each part of the work took." };

    public void AddTo(Command command) => SharedOptions.AddAll(command, _quiet, _verbose);

    public WrittenReport Begin(ParseResult result) => new(result.GetValue(_quiet), result.GetValue(_verbose));
}
