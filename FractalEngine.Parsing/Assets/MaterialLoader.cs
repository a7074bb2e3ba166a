using System.Collections.Immutable;
using FractalEngine.Core.Geometry;
using FractalEngine.Parsing.Meshes;
using FractalEngine.Parsing.Text;

namespace FractalEngine.Parsing.Assets;

/// <summary>
/// Loads the materials of meshes and looks for their pictures. Each file is read once, however many meshes name it. Nothing is an error:
/// what can't be had gives a warning, and the mesh is drawn without it.
/// </summary>
/// <param name="references">Says which files may be named.</param>
/// <param name="warnings">Receives what is wrong.</param>
internal sealed class MaterialLoader(FileReferenceResolver references, List<Diagnostic> warnings)
{
    // Beyond so many missing pictures, one more message tells nobody anything.
    private const int MaxTextureWarnings = 20;

    private readonly Dictionary<string, MtlFile?> _materialFiles = [];
    private readonly Dictionary<(MtlFile File, string Name), Material> _materials = [];

    // The pictures that were looked at, and whether they are fit.
    private readonly Dictionary<string, bool> _textureFiles = [];
    private readonly HashSet<(string Referrer, string File)> _reportedTextures = [];
    private long _totalPixels;
    private int _textureWarningCount;

    /// <summary>The size of all files looked at, each once.</summary>
    public long StorageBytes { get; private set; }

    /// <summary>The materials that a mesh's groups name, as far as there are any.</summary>
    /// <param name="mesh">Parsed.</param>
    /// <param name="source">Its text.</param>
    /// <param name="fullPath">The full path of its file.</param>
    public ImmutableDictionary<string, Material> Load(ObjFile mesh, SourceText source, string fullPath)
    {
        var names = mesh.Mesh.Groups.Select(group => group.Material).Where(name => name.Length > 0).Distinct().ToArray();
        if (names.Length == 0 || mesh.Mesh.MaterialLibraries.IsEmpty)
        {
            return ImmutableDictionary<string, Material>.Empty;
        }

        var libraries = LoadLibraries(mesh, source, fullPath, out var isComplete);
        var materials = ImmutableDictionary.CreateBuilder<string, Material>();
        foreach (var name in names)
        {
            if (libraries.FirstOrDefault(library => library.File.Materials.ContainsKey(name)) is { File: not null } library)
            {
                materials.Add(name, ResolveMaterial(library.File, library.Full, name));
            }
        }

        var unknownMaterials = names.Where(name => !materials.ContainsKey(name)).ToArray();
        // Where a file is missing that has been said, and its materials are no further news.
        if (unknownMaterials.Length > 0 && isComplete)
        {
            var totalNote = unknownMaterials.Length == 1 ? "" : $" ({unknownMaterials.Length} such materials in all)";
            Warn(source.Diagnose(mesh.MaterialOffsets[unknownMaterials[0]],
                $"no material file declares \"{unknownMaterials[0]}\": drawn in the object's own colour{totalNote}"));
        }

        return materials.ToImmutable();
    }

    private List<(MtlFile File, string Full)> LoadLibraries(ObjFile mesh, SourceText source, string fullPath, out bool isComplete)
    {
        var libraries = new List<(MtlFile File, string Full)>();
        Diagnostic? firstFault = null;
        var faultCount = 0;
        foreach (var (names, offset) in mesh.Mesh.MaterialLibraries.Zip(mesh.MaterialLibraryOffsets))
        {
            foreach (var name in references.Exists(fullPath, names) ? [names] : MaterialFileNames.Split(names))
            {
                // A message costs a look through the whole text: one is enough.
                if (firstFault is not null && !references.Exists(fullPath, name))
                {
                    faultCount++;
                    continue;
                }

                try
                {
                    var (path, displayName) = references.Resolve(source, offset, fullPath, name);
                    if (ReadMaterialFile(path, displayName) is { } file)
                    {
                        libraries.Add((file, path));
                    }
                    else
                    {
                        faultCount++;
                    }
                }
                catch (SourceException fault)
                {
                    firstFault ??= fault.Diagnostic;
                    faultCount++;
                }
            }
        }

        if (firstFault is not null)
        {
            Warn(firstFault with { Message = faultCount == 1
                ? firstFault.Message
                : $"{firstFault.Message} ({faultCount} such files in all)" });
        }

        isComplete = faultCount == 0;
        return libraries;
    }

    /// <summary>Null where the file is no text or too long; that is said once.</summary>
    private MtlFile? ReadMaterialFile(string fullPath, string displayName)
    {
        if (_materialFiles.TryGetValue(fullPath, out var cached))
        {
            return cached;
        }

        try
        {
            var file = MtlParser.Parse(SourceText.Read(fullPath, displayName, ParsingLimits.MaterialBytes, acceptLatin1: true));
            StorageBytes += new FileInfo(fullPath) is { Exists: true } info ? info.Length : 0;
            warnings.AddRange(file.Warnings);
            return _materialFiles[fullPath] = file;
        }
        catch (SourceException fault)
        {
            Warn(fault.Diagnostic);
            return _materialFiles[fullPath] = null;
        }
    }

    /// <summary>A material with the full path of its picture, or without one that can't be had.</summary>
    private Material ResolveMaterial(MtlFile file, string fullPath, string name)
    {
        if (_materials.TryGetValue((file, name), out var cached))
        {
            return cached;
        }

        var material = file.Materials[name];
        if (material.Texture is { } texture)
        {
            material = FindTextureFile(file.Source, file.TextureNameOffsets[name], fullPath, texture.Path) is { } path
                ? material with { Texture = texture with { Path = path } }
                : material.WithoutTexture();
        }

        return _materials[(file, name)] = material;
    }

    private string? FindTextureFile(SourceText source, int offset, string referrer, string file)
    {
        if (_textureWarningCount >= MaxTextureWarnings && !references.Exists(referrer, file))
        {
            return null;
        }

        try
        {
            var (fullPath, _) = references.Resolve(source, offset, referrer, file);
            if (!_textureFiles.TryGetValue(fullPath, out var isUsable))
            {
                _textureFiles[fullPath] = false;
                CheckTextureFile(source, offset, fullPath, file);
                isUsable = _textureFiles[fullPath] = true;
            }

            return isUsable ? fullPath : null;
        }
        catch (SourceException fault)
        {
            // Said once of each file, however many materials name it.
            if (_reportedTextures.Add((source.FileName, file)) && ++_textureWarningCount <= MaxTextureWarnings)
            {
                var suffix = _textureWarningCount < MaxTextureWarnings ? "" : "; further pictures that can't be had are not named";
                Warn(fault.Diagnostic with { Message = $"{fault.Diagnostic.Message}: drawn grey{suffix}" });
            }

            return null;
        }
    }

    private void CheckTextureFile(SourceText source, int offset, string fullPath, string file)
    {
        try
        {
            // Pipes and devices say that they are empty, and opening one may wait for ever.
            if (new FileInfo(fullPath).Length == 0)
            {
                throw source.Error(offset, $"\"{file}\" is empty, expected a picture");
            }

            using var stream = new FileStream(fullPath, FileMode.Open, FileAccess.Read, FileShare.Read);
            if (stream.Length > ParsingLimits.ImageBytes)
            {
                throw source.Error(offset, $"the picture \"{file}\" is larger than the limit of {ParsingLimits.ImageBytes} bytes",
                    isLimitExceeded: true);
            }

            var isTga = Path.GetExtension(fullPath).Equals(".tga", StringComparison.OrdinalIgnoreCase);
            if (ImageSizeReader.Read(stream, isTga) is not ( > 0 and var width, > 0 and var height))
            {
                throw source.Error(offset, $"\"{file}\" is no PNG, JPEG, BMP or TGA picture");
            }

            if (Math.Max(width, height) > ParsingLimits.ImageSide)
            {
                throw source.Error(
                    offset, $"the picture \"{file}\" has {width}×{height} pixels, more than the limit of {ParsingLimits.ImageSide} a side",
                    isLimitExceeded: true);
            }

            if (_totalPixels + (width * height) > ParsingLimits.TotalImagePixels)
            {
                throw source.Error(
                    offset, $"with \"{file}\" all pictures have more than the limit of {ParsingLimits.TotalImagePixels} pixels",
                    isLimitExceeded: true);
            }

            _totalPixels += width * height;
            StorageBytes += stream.Length;
        }
        catch (Exception exception) when (exception is IOException or UnauthorizedAccessException)
        {
            throw source.Error(offset, $"the picture \"{file}\" can't be read: {exception.Message}");
        }
    }

    private void Warn(Diagnostic diagnostic) => warnings.Add(diagnostic with { Severity = DiagnosticSeverity.Warning });
}
