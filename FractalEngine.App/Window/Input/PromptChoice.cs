using FractalEngine.Render.Windowing.Keyboard;

namespace FractalEngine.App.Window.Input;

/// <summary>One answer of a <see cref="ChoicePrompt"/>.</summary>
/// <param name="Key">The key that gives the answer.</param>
/// <param name="Text">What the answer does, for the user.</param>
/// <param name="Run">Runs the answer; null for an answer that only closes the question.</param>
internal sealed record PromptChoice(Key Key, string Text, Action? Run);
