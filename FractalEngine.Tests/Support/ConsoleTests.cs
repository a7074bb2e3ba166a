namespace FractalEngine.Tests.Support;

/// <summary>
/// Tests that run commands of the program in the process of the tests: they share the console, the current folder and the limits, so they
/// run alone.
/// </summary>
[CollectionDefinition(Name, DisableParallelization = true)]
public class ConsoleTests
{
    public const string Name = "Console";
}
