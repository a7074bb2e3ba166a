using FractalEngine.Core;
using FractalEngine.Core.Geometry;
using FractalEngine.Parsing.Meshes;
using FractalEngine.Parsing.Text;
using FractalEngine.Tests.Recorded;

namespace FractalEngine.Tests.Geometry;

/// <summary>Small meshes and materials with every construct, and what becomes of them, on one line.</summary>
internal static class MeshTexts
{
    /// <summary>Meshes with every construct of OBJ files.</summary>
    public static readonly string[] Objs =
    [
        "# c\nmtllib a.mtl b.mtl\no one\nv 0 0 0\nv 1 0 0 1\nv 1 1 0 1 0.5 0.25\nv 0 1 0 0.1 0.2 0.3\nvt 0 0\nvt 1\nvt 1 1 0\nvn 0 0 1\n"
        + "g left\nusemtl red\ns 1\nf 1 2 3\nf 1/1 2/2 3/3\ng\ns off\nusemtl\nf 1//1 2//1 3//1 4//1\nf -1/-1/-1 -2/-2/-1 -3/-3/-1\nl "
            + "1 2\np 1\ns on\nf 1/1/1 2//1 3\n",
        "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 2 0 0\nv 0 1 0\nf 1 2 \\\n 3 4 5\nf 5 4 3 2 1 # c\nf 1 1 1\nf 1 2\nfoo\n",
        "o a\rg b\r\nv 1 2 3\nv 1 2 4\nv nan 0 0\nf 1 2 1\n",
    ];

    /// <summary>Material files with every statement.</summary>
    public static readonly string[] Mtls =
    [
        "# c\nnewmtl a b\nKd 0.1 0.2 0.3\nKa 0.5\nKs 1 1 1\nKe 0 1 2\nNs 96\nd 0.25\nTr 0.9\nillum 2\nmap_Kd -clamp on -s 2 3 -o 0.5 "
            + "-blendu off wood.png\n",
        "newmtl a\nTr 0.25\nmap_d holes.png\nmap_Ke glow.png\nmap_Bump -bm 0.5 bumps.png\nnorm n.png\nPr 0.5\nPm 1\nnewmtl a\nKd 0 0 "
            + "0\nmap_Kd x.png\nnewmtl c\nd -halo 0.5\nTr 1\n",
        "newmtl c\nmap_Kd -mm 0 1 -t 1 2 3 -texres 4 -boost 1 -imfchan r -type sphere -cc on 2 a\\b.png # c\nbump -s 1 1 1 1.png\n",
    ];

    /// <summary>Describes what comes of reading or writing, or of its error. Paths of the folder are masked.</summary>
    public static string Outcome(string folder, Func<object> read)
    {
        try
        {
            object value = read();
            string text = value is ParsedObj parsed ? $"{Sums(parsed.Mesh)} {parsed.ByteCount} {string.Join(' ', parsed.Warnings)}"
                : value is SourceText source ? $"{source.HasByteOrderMark} {source.ByteCount} {source.Text}" : $"{value}";
            return text.Replace("\r", "␍", StringComparison.Ordinal).Replace("\n", "⏎", StringComparison.Ordinal).Replace(folder,
                "<folder>", StringComparison.Ordinal);
        }
        catch (FractalEngineException exception)
        {
            return $"{exception.Kind} {exception.Message.Replace("\n", "⏎", StringComparison.Ordinal)}".Replace(folder, "<folder>",
                StringComparison.Ordinal);
        }
    }

    /// <summary>Describes a mesh by the sums of its arrays and its groups.</summary>
    public static string Sums(Mesh mesh)
    {
        string[] arrays =
        [
            Description.OfNumbers(mesh.Positions), Description.OfNumbers([.. mesh.VertexIndices.Select(index => (double)index)]),
            Description.OfNumbers(mesh.TextureCoordinates), Description.OfNumbers([.. mesh.TextureIndices.Select(index => (double)index)]),
            Description.OfNumbers(mesh.Normals), Description.OfNumbers([.. mesh.NormalIndices.Select(index => (double)index)]),
                Description.OfNumbers(mesh.Colours),
        ];
        var filled = arrays.Select((sum, i) => (Sum: sum, Index: i)).Where(pair => pair.Sum != "[0: 0.0 0.0]");
        var groups = mesh.Groups.Select(
            group => $"{group.FirstFace}+{group.FaceCount} {group.ObjectName}/{group.GroupName}/{group.Material}/{group.SmoothingGroup}");
        return $"{string.Join(' ', filled.Select(pair => $"{pair.Index}{pair.Sum}"))} {string.Join(' ', groups)}"
            + string.Concat(mesh.MaterialLibraries.Select(library => $" {library}"));
    }
}
