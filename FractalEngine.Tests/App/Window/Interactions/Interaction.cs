namespace FractalEngine.Tests.App.Window.Interactions;

/// <summary>What a user does in a window, and what must come of it.</summary>
/// <param name="Name">Names the interaction in the results of the tests.</param>
/// <param name="File">The file that is opened.</param>
/// <param name="Events">Keys, clicks and drags, as X events.</param>
/// <param name="Expectations">What pixels, files or state must show.</param>
internal sealed record Interaction(
    string Name, string File, IReadOnlyList<Action<Scenario>> Events, IReadOnlyList<Action<Scenario>> Expectations)
{
    /// <summary>Lines of the settings that the window begins with.</summary>
    public string Settings { get; init; } = "";

    /// <summary>Whether it opens <c>large.obj</c>, which takes about a second to load.</summary>
    public bool NeedsLargeFile { get; init; }

    /// <summary>Options of the command line.</summary>
    public IReadOnlyList<string> Options { get; init; } = [];
}
