using FractalEngine.Core;
using FractalEngine.Core.Scenes;
using FractalEngine.Parsing.Text;

namespace FractalEngine.Parsing;

/// <summary>Finds the files of a scene's models, and writes models without a file beside the scene, each once.</summary>
/// <param name="scenePath">Full path of the scene's file.</param>
/// <param name="companions">Receives the files that are written.</param>
internal sealed class SceneModelWriter(string scenePath, NewFiles companions)
{
    private readonly Dictionary<Model, string> _files = new(ReferenceEqualityComparer.Instance);

    /// <summary>Returns the name of an object's file, relative to the scene.</summary>
    /// <exception cref="FractalEngineException">The object has neither a model nor a file, or its model can't be expressed.</exception>
    /// <exception cref="IOException">A file can't be written.</exception>
    public string FileOf(SceneObject declared)
    {
        if (declared.Model is not { } model)
        {
            return declared.File ?? throw new FractalEngineException(
                $"the object '{declared.DisplayName}' can't be written: it has neither a model nor a file");
        }

        if (!_files.TryGetValue(model, out var file))
        {
            var isOnDisk = model.SourcePath is { } path && File.Exists(path);
            file = FileReference.Create(scenePath, isOnDisk ? model.SourcePath! : WriteModel(declared, model));
            _files.Add(model, file);
        }

        return file;
    }

    private string WriteModel(SceneObject declared, Model model)
    {
        var name = declared.Name ?? Path.GetFileNameWithoutExtension(model.Name);
        var fileName = $"{Path.GetFileNameWithoutExtension(scenePath)}-{string.Concat(name.Select(ToFileNameCharacter))}";
        var path = Path.Combine(Path.GetDirectoryName(scenePath)!, fileName);
        if (model is not FractalModel fractal)
        {
            return MeshFile.WriteNew($"{path}.obj", model.Mesh, model.Materials, companions);
        }

        var text = FractalFile.WriteText($"{path}.fdo", fractal.Fractal, fractal.MaterialsAt, companions);
        return companions.Write($"{path}.fdo", stream => stream.Write(text));
    }

    private static char ToFileNameCharacter(char character) =>
        char.IsAsciiLetterOrDigit(character) || character is '-' or '_' ? character : '-';
}
