using System.CommandLine;

namespace FractalEngine.App.Options;

/// <summary>A command whose help ends with examples.</summary>
/// <param name="name">The word on the command line.</param>
/// <param name="description">The sentence in the help text.</param>
/// <param name="examples">Arguments as on a command line, without the name of the program.</param>
internal sealed class DocumentedCommand(string name, string description, params string[] examples) : Command(name, description)
{
    /// <summary>Arguments as on a command line, without the name of the program.</summary>
    public IReadOnlyList<string> Examples => examples;
}
