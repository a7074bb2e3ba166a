using FractalEngine.App.Shell;
using FractalEngine.Core.Files;
using FractalEngine.Core.Scenes;
using FractalEngine.Parsing.Assets.References;
using FractalEngine.Parsing.Mtl;

namespace FractalEngine.App.Jobs;

/// <summary>The material file that <c>export</c> writes beside a mesh.</summary>
internal sealed class ExportedMaterials
{
    private readonly string _fullPath;

    private ExportedMaterials(SceneMaterials materials, string path)
    {
        Materials = materials;
        Path = path;
        Name = System.IO.Path.GetFileName(path);
        // Two dots lead out of the folder that a link leads to, not out of the one with the link.
        var folder = System.IO.Path.GetDirectoryName(System.IO.Path.GetFullPath(path))!;
        _fullPath = System.IO.Path.Combine(AssetFolder.ResolveLinks(folder), Name);
    }

    public SceneMaterials Materials { get; }

    /// <summary>Path of the file: that of the mesh, with another ending.</summary>
    public string Path { get; }

    /// <summary>Name of the file within its folder, by which the mesh refers to it.</summary>
    public string Name { get; }

    /// <summary>Returns the material file of an export; null where there are no materials, or no file that could name them.</summary>
    /// <param name="scene">Scene that is exported.</param>
    /// <param name="output">Path of the mesh; '-' is the standard output.</param>
    /// <exception cref="UsageException">Another file has its name.</exception>
    public static ExportedMaterials? For(LoadedScene scene, string output)
    {
        if (output == StandardInput.Name || FileTypes.IsSpecial(output) || SceneMaterials.Of(scene) is not { IsEmpty: false } materials)
        {
            return null;
        }

        var path = System.IO.Path.ChangeExtension(output, ".mtl");
        if (!SceneMaterials.CanBeNamed(System.IO.Path.GetFileName(path)))
        {
            throw new UsageException(
                $"a mesh can't name the material file '{System.IO.Path.GetFileName(path)}', which has a comment, a line break or blanks at "
                + "an end: choose another name, or write none with --no-materials");
        }

        InputFiles.Protect(path);
        if (System.IO.Path.Exists(path) && !SceneMaterials.IsExport(path))
        {
            throw new UsageException(
                $"{path} was not written by an export, and is not replaced: choose another name, or write none with --no-materials");
        }

        return new(materials, path);
    }

    public void Write(Stream stream) => Materials.Write(stream, _fullPath);

    public string Describe() => Materials.Count == 1
        ? $"1 material in {Name}"
        : FormattableString.Invariant($"{Materials.Count} materials in {Name}");

    /// <summary>Warns where loading the mesh would refuse textures, since they lie outside its folder.</summary>
    public IEnumerable<string> FindOutsideTextures()
    {
        var folder = AssetFolder.ForFile(_fullPath);
        var outside = Materials.Textures.Where(texture => !folder.Contains(texture)).ToArray();
        if (outside.Length > 0)
        {
            var which = outside.Length == 1
                ? $"the texture {outside[0]} lies"
                : FormattableString.Invariant($"{outside.Length} textures, {outside[0]} first, lie");
            yield return $"{Path}: warning: {which} outside the folder of the mesh: load it with --allow-outside, or copy the images";
        }
    }
}
