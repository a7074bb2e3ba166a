namespace FractalEngine.App.Window.State;

/// <summary>Why the document can't be loaded again.</summary>
/// <param name="Request">The load that has failed.</param>
/// <param name="Error">Lines for the user.</param>
/// <param name="ShownFrom">When it is shown, unless another load ends before.</param>
internal sealed record LoadFault(LoadRequest Request, string Error, TimeSpan ShownFrom);
