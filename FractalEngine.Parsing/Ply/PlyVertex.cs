namespace FractalEngine.Parsing.Ply;

/// <summary>What the properties of a vertex in a PLY file mean: its role, a number from 0.</summary>
internal static class PlyVertex
{
    /// <summary>Role of properties that mean nothing here.</summary>
    public const int Ignored = -1;

    /// <summary>Role of the third coordinate; those before it are the first two.</summary>
    public const int Z = 2;

    /// <summary>Role of the first component of the normal, which two more follow.</summary>
    public const int NormalX = 3;

    /// <summary>Role of the first texture coordinate, which the second follows.</summary>
    public const int U = 6;

    /// <summary>Role of the first component of the colour, which two more follow.</summary>
    public const int Red = 8;

    /// <summary>Number of roles that are not ignored.</summary>
    public const int RoleCount = 11;

    private static readonly string[][] Names =
    [
        ["x"], ["y"], ["z"], ["nx", "normal_x"], ["ny", "normal_y"], ["nz", "normal_z"],
        ["u", "s", "texture_u", "texture_s"], ["v", "t", "texture_v", "texture_t"],
        ["red", "r", "diffuse_red"], ["green", "g", "diffuse_green"], ["blue", "b", "diffuse_blue"],
    ];

    /// <summary>Returns the factor of a property's numbers: integers of colours count from 0 to their largest.</summary>
    public static double FactorOf(int role, PlyType type) => role < Red ? 1 : 1 / type.ColourUnit;

    /// <summary>Returns the role of a property by its name.</summary>
    public static int RoleOf(string name) => Array.FindIndex(Names, names => names.Contains(name));

    /// <summary>Returns the name of a coordinate that no property has; null if there is none.</summary>
    public static string? MissingCoordinate(int[] roles) =>
        Enumerable.Range(0, Z + 1).Where(role => !roles.Contains(role)).Select(role => Names[role][0]).FirstOrDefault();

    /// <summary>Returns whether there are properties of all of some successive roles.</summary>
    public static bool HasAll(int[] roles, int firstRole, int count) =>
        Enumerable.Range(firstRole, count).All(role => roles.Contains(role));
}
