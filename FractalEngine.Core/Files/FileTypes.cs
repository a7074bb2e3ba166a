using System.Diagnostics;
using System.Runtime.InteropServices;
using System.Text;

namespace FractalEngine.Core.Files;

/// <summary>Tells regular files from devices, pipes and sockets, which .NET does not.</summary>
public static class FileTypes
{
    // These are from <sys/stat.h>, with the same values on Linux and macOS.
    private const int TypeMask = 0xF000;
    private const int RegularFile = 0x8000;
    private const int FolderType = 0x4000;
    private const int PipeType = 0x1000;

    // From <fcntl.h>: O_WRONLY with O_NONBLOCK.
    private const int LinuxWriteWithoutWaiting = 0x801;
    private const int MacWriteWithoutWaiting = 0x5;

    // From <errno.h>: ENXIO, with the same value on Linux and macOS.
    private const int NoReaderError = 6;

    private static readonly TimeSpan ReaderTimeout = TimeSpan.FromSeconds(2);
    private static readonly TimeSpan ReaderPollInterval = TimeSpan.FromMilliseconds(20);

    // Offset of stx_mode in struct statx of Linux, which is the same on every processor.
    private const int LinuxModeOffset = 28;
    private const int CurrentDirectory = -100;
    private const uint StatxType = 1;

    // Offset of st_mode in struct stat of macOS with inodes of 64 bits.
    private const int MacModeOffset = 4;

    // More than either structure has.
    private const int BufferBytes = 512;

    /// <summary>True for an existing device, pipe or socket, through symbolic links. False where the system does not say.</summary>
    /// <param name="path">Path of a file that may be missing.</param>
    public static bool IsSpecial(string path)
    {
        if (OperatingSystem.IsWindows())
        {
            // Names such as NUL become paths in the folder of devices.
            return Path.GetFullPath(path).StartsWith(@"\\.\", StringComparison.Ordinal);
        }

        try
        {
            return ReadMode(path) is { } mode && (mode & TypeMask) is not (RegularFile or FolderType);
        }
        catch (Exception exception) when (exception is DllNotFoundException or EntryPointNotFoundException)
        {
            return false;
        }
    }

    /// <summary>
    /// Opens a device or a pipe for writing. Opening a named pipe would wait for a program that reads it, perhaps for ever: it has two
    /// seconds to appear.
    /// </summary>
    /// <param name="path">Path for which <see cref="IsSpecial"/> holds.</param>
    /// <param name="bufferBytes">Size of the stream's buffer.</param>
    /// <exception cref="IOException">It can't be opened, or nothing reads the pipe.</exception>
    internal static FileStream OpenForWriting(string path, int bufferBytes)
    {
        if (OperatingSystem.IsWindows() || ReadMode(path) is not { } mode || (mode & TypeMask) != PipeType)
        {
            return Open();
        }

        // The time of day may jump.
        var waiting = Stopwatch.StartNew();
        var flags = OperatingSystem.IsMacOS() ? MacWriteWithoutWaiting : LinuxWriteWithoutWaiting;
        int descriptor;
        while ((descriptor = OpenFile(Encoding.UTF8.GetBytes(path + '\0'), flags)) < 0)
        {
            if (Marshal.GetLastPInvokeError() != NoReaderError)
            {
                // It fails in the same way, with a message.
                return Open();
            }

            if (waiting.Elapsed > ReaderTimeout)
            {
                throw new IOException("it is a pipe that nothing reads");
            }

            Thread.Sleep(ReaderPollInterval);
        }

        try
        {
            // While the first descriptor is open, the reader does not meet the end of the pipe.
            return Open();
        }
        finally
        {
            _ = CloseFile(descriptor);
        }

        FileStream Open() => new(path, FileMode.Open, FileAccess.Write, FileShare.ReadWrite, bufferBytes);
    }

    private static int? ReadMode(string path)
    {
        var name = Encoding.UTF8.GetBytes(path + '\0');
        var buffer = new byte[BufferBytes];
        if (OperatingSystem.IsLinux())
        {
            return ReadLinuxStatus(CurrentDirectory, name, 0, StatxType, buffer) == 0
                ? BitConverter.ToUInt16(buffer, LinuxModeOffset)
                : null;
        }

        if (OperatingSystem.IsMacOS())
        {
            var result = RuntimeInformation.ProcessArchitecture == Architecture.X64
                ? ReadIntelMacStatus(name, buffer)
                : ReadMacStatus(name, buffer);
            return result == 0 ? BitConverter.ToUInt16(buffer, MacModeOffset) : null;
        }

        return null;
    }

    [DllImport("libc", EntryPoint = "statx")]
    private static extern int ReadLinuxStatus(int folder, byte[] path, int flags, uint mask, byte[] buffer);

    [DllImport("libc", EntryPoint = "open", SetLastError = true)]
    private static extern int OpenFile(byte[] path, int flags);

    [DllImport("libc", EntryPoint = "close")]
    private static extern int CloseFile(int descriptor);

    [DllImport("libc", EntryPoint = "stat")]
    private static extern int ReadMacStatus(byte[] path, byte[] buffer);

    [DllImport("libc", EntryPoint = "stat$INODE64")]
    private static extern int ReadIntelMacStatus(byte[] path, byte[] buffer);
}
