using FractalEngine.App.Approximation;
using FractalEngine.App.Window.Files;
using FractalEngine.App.Window.Input;
using FractalEngine.Core;
using FractalEngine.Core.Approximation;
using FractalEngine.Core.Files;
using FractalEngine.Core.Maths;
using FractalEngine.Core.Scenes;
using FractalEngine.Parsing;
using FractalEngine.Parsing.Approximation;
using FractalEngine.Parsing.Editing;

namespace FractalEngine.App.Window.Loading;

/// <summary>Looks for a fractal that makes what the window shows, and opens a scene with it beside the model.</summary>
/// <param name="loader">Owns the document.</param>
/// <param name="files">Opens what is found.</param>
/// <param name="prompts">Asks for a name.</param>
/// <param name="report">Shows a message.</param>
/// <param name="wake">Lets the window look at the search, from any thread.</param>
internal sealed class WindowApproximation(
    DocumentLoader loader, FileCommands files, PromptHost prompts, Action<string> report, Action wake)
    : WindowJob("Approximate", report, wake), IProgress<ApproximationProgress>
{
    // The fractal stands beside the model, with a part of its width between them.
    private const double Gap = 0.2;

    /// <summary>Asks for a name and begins the search, or ends one that runs.</summary>
    /// <param name="opened">Called once what was found is opened.</param>
    public void Toggle(Action opened)
    {
        if (!Stop())
        {
            var model = loader.Document!.File.Path;
            var proposal = NewFile.Propose($"{Path.ChangeExtension(model, null)}-fractal", ".fdo", static path => !Path.Exists(path));
            prompts.Open(new TextPrompt(
                "Name of the fractal for what is shown", PathText.Shorten(proposal), text => TryStart(text, opened)));
        }
    }

    public void Report(ApproximationProgress value)
    {
        var best = value.Best is { } result ? FormattableString.Invariant($"\nbest so far: {result.Bytes} bytes") : "";
        Status = $"looking for {value.Stage}{best}";
    }

    /// <summary>Returns why a name is refused; null where the search has begun.</summary>
    private string? TryStart(string text, Action opened)
    {
        var path = PathText.Expand(text, ".fdo");
        var scenePath = Path.ChangeExtension(path, ".sdo");
        try
        {
            NewFile.Require(path, "a fractal", ".fdo");
            NewFile.Require(scenePath, "a scene", ".sdo");
        }
        catch (IOException exception)
        {
            return exception.Message;
        }

        var (file, scene) = (loader.Document!.File, loader.Document.GetCurrentScene());
        Start("expanding the scene", cancellation =>
        {
            var mesh = file.Scene.Objects.Flatten(ApproximationLimits.Faces.Value);
            var result = mesh.FaceCount > 0 && mesh.UsedBounds.Diagonal > 0
                ? MeshApproximator.Find(mesh, null, this, cancellation)
                : throw new FractalEngineException("there are no faces, so there is nothing to approximate");
            cancellation.ThrowIfCancellationRequested();
            return () =>
            {
                var lines = new ApproximationText(mesh, result).Lines().ToArray();
                GrammarFile.Write(path, result.Grammar, result.Distance.Diagonal, lines);
                var name = Path.GetRelativePath(Path.GetDirectoryName(file.Path)!, path).Replace(Path.DirectorySeparatorChar, '/');
                var place = new Vector((1 + Gap) * mesh.UsedBounds.Size.X, 0, 0);
                var found = new SceneObject(name, Transformation.At(place));
                var both = scene with { Camera = null, Objects = scene.Objects.Add(found) };
                NewSceneFile.Write(file, both, scenePath, loader.Options.AllowOutsideFiles);
                Tell(string.Join('\n', lines));
                files.Open(PathText.Shorten(scenePath));
                opened();
            };
        });
        return null;
    }
}
