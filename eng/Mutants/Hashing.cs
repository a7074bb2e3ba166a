using System.Buffers.Binary;
using System.Security.Cryptography;
using System.Text;

namespace FractalEngine.Mutants;

/// <summary>Hashes of texts that are the same on every machine.</summary>
internal static class Hashing
{
    /// <summary>The first digits of the hash.</summary>
    public static string Hex(string text, int digits) =>
        Convert.ToHexStringLower(SHA256.HashData(Encoding.UTF8.GetBytes(text)))[..digits];

    /// <summary>The hash as a number to sort by: a random order that a seed in the text chooses.</summary>
    public static ulong Rank(string text) => BinaryPrimitives.ReadUInt64BigEndian(SHA256.HashData(Encoding.UTF8.GetBytes(text)));
}
